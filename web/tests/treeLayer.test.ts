import { expect, test } from "vitest";
import { TreeLayer } from "../src/draw/treeLayer";

test("a tree lags behind after edges have moved, until it is gone", () => {
  const layer = new TreeLayer();
  layer.add({ vertices: [0, 0, 1, 0, 2, 0], parents: [-1, 0, 1] });
  expect(layer.lags).toBe(false);
  layer.add({ first: 3, vertices: [1, 1], parents: [0], changed: [2, 3] });
  expect(layer.lags).toBe(true);
  layer.clear();
  expect(layer.lags).toBe(false);
  layer.add({ vertices: [0, 0], parents: [-1] });
  expect(layer.lags).toBe(false);
});
