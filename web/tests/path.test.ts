import { describe, expect, test } from "vitest";
import { along, carOutline, lengths, Walker } from "../src/geometry/path";
import { rounded, wrapAngle } from "../src/geometry/points";

/** A quarter of a circle of radius 2 to the left, then a metre straight on. */
const TURN = [
  ...Array.from({ length: 91 }, (_, degree) => {
    const angle = (degree * Math.PI) / 180;
    return [2 * Math.sin(angle), 2 - 2 * Math.cos(angle), angle];
  }),
  [2, 3, Math.PI / 2],
];

describe("Walker", () => {
  test("measures polylines", () => {
    expect(
      lengths([
        [0, 0],
        [3, 4],
        [3, 6],
      ]),
    ).toEqual([0, 5, 7]);
    expect(new Walker([]).length).toBe(0);
  });

  test("a position looks along its segment", () => {
    const walker = new Walker([
      [0, 0],
      [4, 0],
      [4, 2],
    ]);
    expect(walker.at(3)).toEqual({ x: 3, y: 0, yaw: 0 });
    expect(walker.at(5)).toEqual({ x: 4, y: 1, yaw: Math.PI / 2 });
  });

  test("beyond its ends it stays there", () => {
    const walker = new Walker([
      [0, 0],
      [4, 0],
    ]);
    expect(walker.at(-1)).toMatchObject({ x: 0, y: 0 });
    expect(walker.at(99)).toMatchObject({ x: 4, y: 0 });
    expect(new Walker([[1, 2]]).at(5)).toMatchObject({ x: 1, y: 2 });
  });

  test("a car keeps its heading and its circle on an arc", () => {
    const walker = new Walker(TURN);
    expect(walker.length).toBeCloseTo(Math.PI + 1, 3);
    for (const length of [0.4, 1.3, 2.9]) {
      const { x, y, yaw } = walker.at(length);
      expect(Math.hypot(x, y - 2)).toBeCloseTo(2, 3);
      expect(yaw).toBeCloseTo(length / 2, 3);
    }
    expect(walker.at(Math.PI + 0.5)).toEqual({
      x: expect.closeTo(2),
      y: expect.closeTo(2.5, 3),
      yaw: expect.closeTo(Math.PI / 2),
    });
  });

  test("a heading turns the short way across the half turn", () => {
    const walker = new Walker([
      [0, 0, 3],
      [-1, 0, -3],
    ]);
    const { yaw } = walker.at(0.5);
    expect(Math.abs(yaw)).toBeCloseTo(Math.PI);
  });

  test("a reversing car keeps its nose where it is", () => {
    const walker = new Walker([
      [0, 0, 0],
      [-2, 0, 0],
    ]);
    expect(walker.at(1)).toEqual({ x: -1, y: 0, yaw: 0 });
  });
});

test("cars along a path leave its ends free and keep their distance", () => {
  const poses = along(
    [
      [0, 0],
      [10, 0],
    ],
    2,
    14,
  );
  expect(poses).toHaveLength(5);
  expect(poses.map(({ x }) => x)).toEqual([1, 2, 3, 4, 5].map((i) => expect.closeTo((10 * i) / 6)));
  expect(
    along(
      [
        [0, 0],
        [100, 0],
      ],
      1,
      14,
    ),
  ).toHaveLength(14);
});

test("a car's outline lies in its disc, nose first", () => {
  const outline = carOutline({ x: 1, y: 2, yaw: Math.PI / 2 }, 0.5);
  for (const [x, y] of outline) expect(Math.hypot(x - 1, y - 2)).toBeLessThanOrEqual(0.5);
  const [nose] = outline;
  expect(nose).toEqual([expect.closeTo(1), expect.closeTo(2.45)]);
});

test("angles wrap into one turn", () => {
  expect(wrapAngle(3 * Math.PI)).toBeCloseTo(-Math.PI);
  expect(wrapAngle(-0.1)).toBeCloseTo(-0.1);
  expect(wrapAngle(7)).toBeCloseTo(7 - 2 * Math.PI);
});

test("rounding never gives a negative zero", () => {
  expect(Object.is(rounded(-0.0001, 2), 0)).toBe(true);
  expect(rounded(1.23456, 3)).toBe(1.235);
});
