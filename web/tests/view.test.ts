import { describe, expect, test } from "vitest";
import { clampToMap, toWorld as localToWorld, mapBounds, toLocal } from "../src/geometry/frame";
import {
  between,
  fit,
  panned,
  toScreen,
  toWorld,
  type View,
  worldMatrix,
  zoomed,
} from "../src/geometry/view";

const SIZE = { width: 800, height: 600 };
const VIEW: View = { centre: { x: 3, y: -2 }, scale: 40 };

describe("view", () => {
  test("screen and world are inverse", () => {
    const world = toWorld(VIEW, SIZE, { x: 123, y: 456 });
    expect(toScreen(VIEW, SIZE, world)).toEqual({ x: expect.closeTo(123), y: expect.closeTo(456) });
  });

  test("y points up in the world and down on the screen", () => {
    const above = toScreen(VIEW, SIZE, { x: 3, y: -1 });
    expect(above).toEqual({ x: 400, y: 260 });
  });

  test("the matrix agrees with toScreen", () => {
    const [a, b, c, d, e, f] = worldMatrix(VIEW, SIZE, 2);
    const { x, y } = { x: 5.5, y: 0.25 };
    const screen = toScreen(VIEW, SIZE, { x, y });
    expect(a * x + c * y + e).toBeCloseTo(2 * screen.x);
    expect(b * x + d * y + f).toBeCloseTo(2 * screen.y);
  });

  test("a fitted map lies inside the margin and touches it on one axis", () => {
    const bounds = { left: -1, right: 9, bottom: 4, top: 8 };
    const view = fit(bounds, SIZE, 10);
    const low = toScreen(view, SIZE, { x: -1, y: 4 });
    const high = toScreen(view, SIZE, { x: 9, y: 8 });
    expect(low.x).toBeCloseTo(10);
    expect(high.x).toBeCloseTo(790);
    expect(high.y).toBeGreaterThan(10);
    expect(low.y).toBeLessThan(590);
  });

  test("zooming keeps the point under the pointer", () => {
    const at = { x: 700, y: 50 };
    const after = zoomed(VIEW, SIZE, at, 1.7, VIEW);
    expect(after.scale).toBeCloseTo(68);
    const [before, now] = [toWorld(VIEW, SIZE, at), toWorld(after, SIZE, at)];
    expect(now.x).toBeCloseTo(before.x);
    expect(now.y).toBeCloseTo(before.y);
  });

  test("zooming ends at limits", () => {
    expect(zoomed(VIEW, SIZE, { x: 0, y: 0 }, 1e9, VIEW).scale).toBe(40 * 60);
    expect(zoomed(VIEW, SIZE, { x: 0, y: 0 }, 1e-9, VIEW).scale).toBe(20);
  });

  test("what is dragged follows the pointer", () => {
    const world = toWorld(VIEW, SIZE, { x: 100, y: 100 });
    const screen = toScreen(panned(VIEW, 30, -20), SIZE, world);
    expect(screen.x).toBeCloseTo(130);
    expect(screen.y).toBeCloseTo(80);
  });

  test("an image of one view is placed in another", () => {
    const to = zoomed(panned(VIEW, 10, 20), SIZE, { x: 5, y: 7 }, 2, VIEW);
    const { scale, dx, dy } = between(VIEW, to, SIZE);
    const world = { x: 1, y: 1 };
    const [old, now] = [toScreen(VIEW, SIZE, world), toScreen(to, SIZE, world)];
    expect(scale * old.x + dx).toBeCloseTo(now.x);
    expect(scale * old.y + dy).toBeCloseTo(now.y);
  });
});

describe("frame of a map", () => {
  const map = { origin: [2, 1, Math.PI / 2] as [number, number, number], width: 4, height: 3 };

  test("a turned map is turned counter-clockwise", () => {
    const corner = localToWorld(map, { x: 4, y: 0 });
    expect(corner.x).toBeCloseTo(2);
    expect(corner.y).toBeCloseTo(5);
    const back = toLocal(map, corner);
    expect(back.x).toBeCloseTo(4);
    expect(back.y).toBeCloseTo(0);
  });

  test("its bounds hold all corners", () => {
    const { left, right, bottom, top } = mapBounds(map);
    expect([left, right, bottom, top].map((value) => Math.round(value))).toEqual([-1, 2, 1, 5]);
  });

  test("a point beside it moves to its edge, one on it stays", () => {
    const beside = toLocal(map, clampToMap(map, { x: 100, y: 2 }));
    expect(beside).toEqual({ x: expect.closeTo(1), y: expect.closeTo(0.001) });
    const inside = clampToMap(map, { x: 1, y: 2 });
    expect(inside).toEqual({ x: expect.closeTo(1), y: expect.closeTo(2) });
  });
});
