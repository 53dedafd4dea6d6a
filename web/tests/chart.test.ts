import { expect, test } from "vitest";
import { ticks } from "../src/ui/chart";

test("ticks are round and inside the range", () => {
  expect(ticks(0, 1, 5)).toEqual([0, 0.2, 0.4, expect.closeTo(0.6), 0.8, 1]);
  expect(ticks(29.83, 31.2, 4)).toEqual([30, 30.5, 31]);
  expect(ticks(0, 0.0031, 3)).toEqual([0, 0.002]);
});
