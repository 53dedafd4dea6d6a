import { describe, expect, test } from "vitest";
import { decode, encode, exactStroke, type Shared } from "../src/model/share";

const SHARED: Shared = {
  source: {
    kind: "generated",
    request: { kind: "forest", seed: 3, width: 24, height: 18.5, resolution: 0.05 },
    strokes: [
      {
        points: [
          [1, 2],
          [3.25, -4.5],
        ],
        radius: 0.25,
        occupied: true,
      },
      { points: [[7, 8]], radius: 0.4, occupied: false },
    ],
  },
  id: "0123456789abcdef",
  robot: { kind: "dubins", radius: 0.2, turningRadius: 0.55 },
  start: { x: 2, y: 2.125, yaw: 0 },
  goal: { x: 20, y: -1.5, yaw: -1.5708 },
  runs: [
    { planner: "RRTstar", guide: "mpt-dubins", exploration: 0.5 },
    { planner: "SST", guide: null, exploration: 0 },
  ],
  limits: { time: 1.5, seed: 4294967295 },
};

const LONGEST = 10;

describe("a link", () => {
  test("restores the problem", () => {
    expect(decode(encode(SHARED), LONGEST)).toEqual(SHARED);
  });

  test("restores a stored map and a new seed each time", () => {
    const stored: Shared = {
      ...SHARED,
      source: { kind: "stored" },
      limits: { time: 1, seed: null },
    };
    expect(decode(encode(stored), LONGEST)).toEqual(stored);
  });

  test("survives odd names", () => {
    const run = { planner: "A&B=C D", guide: "ü#é ~", exploration: 0 };
    expect(decode(encode({ ...SHARED, runs: [run] }), LONGEST)?.runs).toEqual([run]);
  });

  test("asks for no more time than the server allows", () => {
    expect(decode(encode(SHARED), 1)?.limits.time).toBe(1);
  });

  test("needs no escapes in usual cases", () => {
    expect(encode(SHARED)).toBe(
      "#map=forest,3,24,18.5,0.05&edits=w0.25,1,2,3.25,-4.5~e0.4,7,8&id=0123456789abcdef" +
        "&robot=dubins,0.2,0.55&start=2,2.125,0&goal=20,-1.5,-1.5708" +
        "&run=RRTstar,mpt-dubins,0.5&run=SST,none,0&time=1.5&seed=4294967295",
    );
  });

  test.each([
    "",
    "#",
    "#map=forest",
    encode(SHARED).replace("forest", "jungle"),
    encode(SHARED).replace("start=2,", "start=two,"),
    encode(SHARED).replace("id=0", "id=../../"),
    encode(SHARED).replace("e0.4,7,8", "e0.4,7"),
    encode(SHARED).replace("seed=4", "seed=-4"),
    encode(SHARED).replace("time=1.5", "time=Infinity"),
    encode(SHARED).replace("time=1.5", "time=0"),
    encode(SHARED).replace("dubins,0.2,", "point,-1,"),
    encode(SHARED).replace(",0.2,0.55", ",0.2,0"),
    encode(SHARED).replace("mpt-dubins,0.5", "mpt-dubins,1.5"),
    encode(SHARED).replace("seed=4294967295", "seed=4294967296"),
    encode(SHARED).replace("seed=4294967295", "seed=0.5"),
  ])("that is damaged is refused: %s", (fragment) => {
    expect(decode(fragment, LONGEST)).toBeNull();
  });
});

test("strokes are rounded to what a link holds", () => {
  const stroke = exactStroke({ points: [[1.23456, -0.001]], radius: 0.12345, occupied: true });
  expect(stroke).toEqual({ points: [[1.23, 0]], radius: 0.123, occupied: true });
});
