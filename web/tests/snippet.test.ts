import { expect, test } from "vitest";
import type { MapInfo } from "../src/api/types";
import type { Problem } from "../src/model/problem";
import { snippet } from "../src/model/snippet";

const MAP: MapInfo = {
  id: "0123456789abcdef",
  name: 'de"pot\nimport os',
  rows: 480,
  columns: 480,
  resolution: 0.05,
  origin: [-1.5, 2, 0.1],
  width: 24,
  height: 24,
  occupied: 0.2,
  source: null,
};

const PROBLEM: Problem = {
  map: MAP,
  source: {
    kind: "generated",
    request: { kind: "maze", seed: 7, width: 24, height: 24, resolution: 0.05 },
    strokes: [],
  },
  robot: { kind: "point", radius: 0.1, turningRadius: 0.55 },
  start: { x: 1, y: 2, yaw: 3 },
  goal: { x: 20, y: 21.5, yaw: 0 },
};
const RUN = { planner: "RRTstar", guide: "mpt", exploration: 0.1 };
const IMAGE = "http://127.0.0.1:8000/maps/0123456789abcdef/image";

test("a generated map is generated again", () => {
  const code = snippet({
    problem: PROBLEM,
    run: RUN,
    limits: { time: 1, seed: 5 },
    imageUrl: IMAGE,
  });
  expect(code).toBe(`import planformer as pf

grid = pf.generate_maze(seed=7, width=24, height=24, resolution=0.05)
robot = pf.PointRobot(radius=0.1)
result = pf.plan(
    grid,
    robot,
    start=(1, 2),
    goal=(20, 21.5),
    planner="RRTstar",
    guide="mpt",
    exploration=0.1,
    time_limit=1,
    seed=5,
)
print(result)
print(result.path)
`);
});

test("a car has headings and a turning radius, an unguided plan no exploration", () => {
  const robot = { kind: "reeds-shepp", radius: 0.2, turningRadius: 0.6 } as const;
  const code = snippet({
    problem: { ...PROBLEM, robot },
    run: { ...RUN, guide: null },
    limits: { time: 1, seed: null },
    imageUrl: IMAGE,
  });
  expect(code).toContain("robot = pf.ReedsSheppCar(radius=0.2, turning_radius=0.6)");
  expect(code).toContain("start=(1, 2, 3),");
  expect(code).toContain("guide=None,");
  expect(code).not.toMatch(/exploration|seed=\d+,\n\)/);
});

test("another map is fetched, and its name stays a comment", () => {
  const code = snippet({
    problem: { ...PROBLEM, source: { kind: "stored" } },
    run: RUN,
    limits: { time: 1, seed: 5 },
    imageUrl: IMAGE,
  });
  expect(code).toContain(`with urlopen("${IMAGE}") as response:`);
  expect(code).toContain("origin=(-1.5, 2, 0.1),");
  expect(code).not.toMatch(/^import os/m);
});
