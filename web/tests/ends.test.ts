import { expect, test } from "vitest";
import type { MapInfo } from "../src/api/types";
import { farApart } from "../src/model/ends";
import { FREE, type Raster } from "../src/model/raster";

/** A map out of a drawing: # is occupied, ? unknown. */
function drawn(...lines: string[]): [Raster, MapInfo] {
  const [rows, columns] = [lines.length, lines[0]!.length];
  const cells = Uint8Array.from(lines.join(""), (symbol) =>
    symbol === "#" ? 0 : symbol === "?" ? 127 : FREE,
  );
  const info: MapInfo = {
    id: "0",
    name: "drawn",
    rows,
    columns,
    resolution: 1,
    origin: [10, 20, 0],
    width: columns,
    height: rows,
    occupied: 0,
    source: null,
  };
  return [{ rows, columns, cells }, info];
}

test("start and goal are far apart, at the corners of free space", () => {
  const [raster, info] = drawn(".....", ".....", ".....");
  expect(farApart(raster, info, 0.5)).toEqual([
    { x: 11.5, y: 21.5 },
    { x: 13.5, y: 21.5 },
  ]);
});

test("the goal can be reached from the start", () => {
  const [raster, info] = drawn(
    "...#....",
    "...#....",
    "...#....",
    "########",
    "........",
    "........",
    "........",
  );
  const [start, goal] = farApart(raster, info, 0.3)!;
  expect(start).toEqual({ x: 11.5, y: 21.5 });
  expect(goal).toEqual({ x: 16.5, y: 21.5 });
});

test("unknown space is not free", () => {
  const [raster, info] = drawn("???", "???", "???");
  expect(farApart(raster, info, 0.1)).toBeNull();
});

test("nothing fits a robot that is too large", () => {
  const [raster, info] = drawn("...", "...", "...");
  expect(farApart(raster, info, 5)).toBeNull();
});
