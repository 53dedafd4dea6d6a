import { describe, expect, test } from "vitest";
import { TreeLines } from "../src/model/tree";

const WHOLE = { vertices: [0, 0, 1, 0, 1, 1, 2, 2], parents: [-1, 0, 1, 0] };

describe("TreeLines", () => {
  test("a whole tree becomes one segment a vertex, a point for the root", () => {
    const lines = new TreeLines();
    expect(lines.add(WHOLE)).toBe(false); // nothing was there
    expect([...lines.segments]).toEqual([0, 0, 0, 0, 0, 0, 1, 0, 1, 0, 1, 1, 0, 0, 2, 2]);
  });

  test("increments give the same as the whole", () => {
    const lines = new TreeLines();
    lines.add({ first: 0, vertices: [0, 0, 1, 0], parents: [-1, 0] });
    expect(lines.add({ first: 2, vertices: [1, 1, 2, 2], parents: [1, 0] })).toBe(false);
    const whole = new TreeLines();
    whole.add(WHOLE);
    expect(lines.segments).toEqual(whole.segments);
  });

  test("a vertex may change its parent, and a parent may come after its child", () => {
    const lines = new TreeLines();
    lines.add({ first: 0, vertices: [5, 5, 0, 0], parents: [1, -1] });
    expect([...lines.segments.slice(0, 4)]).toEqual([0, 0, 5, 5]);
    expect(lines.add({ first: 2, vertices: [4, 4], parents: [1], changed: [0, 2] })).toBe(true);
    expect([...lines.segments.slice(0, 4)]).toEqual([4, 4, 5, 5]);
  });

  test("the links of a roadmap replace the former ones", () => {
    const lines = new TreeLines();
    lines.add({ ...WHOLE, links: [0, 2, 1, 3] });
    expect([...lines.links]).toEqual([0, 0, 1, 1, 1, 0, 2, 2]);
    lines.add({ first: 4, vertices: [], parents: [], links: [2, 3] });
    expect([...lines.links]).toEqual([1, 1, 2, 2]);
  });

  test("the edges of a car are curves, which follow their vertices and links", () => {
    const lines = new TreeLines();
    lines.add({ ...WHOLE, links: [1, 3], curves: [[], [0.5, 0.1], [], [1, 1], [3, 3]] });
    expect([0, 1, 2, 3].map((i) => lines.curve(i))).toEqual([[], [0.5, 0.1], [], [1, 1]]);
    expect(lines.linkCurve(0)).toEqual([3, 3]);
    lines.add({
      first: 4,
      vertices: [4, 4],
      parents: [3],
      changed: [1, 3],
      curves: [
        [9, 9],
        [7, 7],
      ],
    });
    expect([1, 3, 4].map((i) => lines.curve(i))).toEqual([
      [7, 7],
      [1, 1],
      [9, 9],
    ]);
    lines.add({ vertices: [0, 0, 1, 1], parents: [-1, 0] });
    expect(lines.curve(1)).toEqual([]); // of a point robot
  });

  test("a whole tree replaces a former one", () => {
    const lines = new TreeLines();
    lines.add(WHOLE);
    lines.add({ vertices: [9, 9], parents: [-1] });
    expect([...lines.segments]).toEqual([9, 9, 9, 9]);
  });

  test("an increment may replace the last vertices", () => {
    const lines = new TreeLines();
    lines.add(WHOLE);
    expect(lines.add({ first: 3, vertices: [9, 9], parents: [1] })).toBe(true);
    expect([...lines.segments.slice(-4)]).toEqual([1, 0, 9, 9]);
    expect(lines.vertices).toBe(4);
  });

  test("a lost increment is noticed", () => {
    const lines = new TreeLines();
    lines.add(WHOLE);
    expect(() => lines.add({ first: 6, vertices: [1, 1], parents: [0] })).toThrow(RangeError);
  });

  test("grows to any size", () => {
    const lines = new TreeLines();
    const count = 60_000;
    const vertices = Array.from({ length: 2 * count }, (_, index) => index);
    lines.add({ vertices, parents: Array.from({ length: count }, (_, index) => index - 1) });
    expect(lines.vertices).toBe(count);
    expect([...lines.segments.slice(-4)]).toEqual([119_996, 119_997, 119_998, 119_999]);
  });
});
