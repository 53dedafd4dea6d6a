import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { Client } from "../src/api/client";
import type { PlanRequest } from "../src/api/types";
import { type Job, Planning } from "../src/app/planning";
import { FakeServer, mapInfo } from "./server";

let server: FakeServer;
let planning: Planning;

beforeEach(() => {
  server = new FakeServer();
  planning = new Planning(
    new Client(server.base),
    () => {},
    () => {},
  );
});

afterEach(() => {
  vi.unstubAllGlobals();
});

/** Planners on an empty map, with the goal at some x. */
function job(x: number, ...planners: string[]): Job {
  return {
    problem: {
      map: mapInfo("a"),
      source: { kind: "stored" },
      robot: { kind: "point", radius: 0.1, turningRadius: 0.55 },
      start: { x: 1, y: 1, yaw: 0 },
      goal: { x, y: 1, yaw: 0 },
    },
    runs: planners.map((planner) => ({ planner, guide: null, exploration: 0 })),
    limits: { time: 1, seed: null },
  };
}

function phases(): string[] {
  return planning.traces.map(({ phase }) => phase);
}

test("a run that is refused leaves alone what the others have found", async () => {
  const done = planning.plan(job(5, "RRT", "nonsense", "SST"));
  (await server.next("plan/stream")).result({ length: 10 });
  (await server.next("plan/stream")).refuse(400, "unknown planner");
  (await server.next("plan/stream")).result({ length: 12 });
  await done;
  expect(phases()).toEqual(["done", "failed", "done"]);
  expect(planning.traces.map(({ length }) => length)).toEqual([10, null, 12]);
  expect(planning.bestPath).toHaveLength(2);
  expect(planning.error?.message).toBe("unknown planner");
});

test("an error is told until a later plan succeeds", async () => {
  const refused = planning.plan(job(5, "RRT"));
  (await server.next("plan/stream")).refuse(400, "in collision");
  await refused;
  const done = planning.plan(job(6, "RRT"));
  expect(planning.error?.message).toBe("in collision");
  (await server.next("plan/stream")).result({});
  await done;
  expect(planning.error).toBeNull();
});

test("a search whose server dies has failed", async () => {
  const done = planning.plan(job(5, "RRT"));
  (await server.next("plan/stream")).breakOff();
  await done;
  expect(phases()).toEqual(["failed"]);
  expect(planning.error?.kind).toBe("Unreachable");
});

for (const [what, later] of [
  ["what is wanted by then", 6],
  ["the same once more", null],
] as const) {
  test(`while one drags, a busy server is asked later for ${what}`, async () => {
    vi.stubGlobal("setTimeout", (wake: () => void) => queueMicrotask(wake));
    const done = planning.follow(job(5, "RRT"));
    (await server.next("plan")).refuse(429, "busy");
    if (later !== null) void planning.follow(job(later, "RRT"));
    const asked = await server.next("plan");
    expect((asked.body as PlanRequest).goal).toEqual([later ?? 5, 1]);
    asked.result({ length: 7 });
    await done;
    expect(planning.traces[0]!.length).toBe(7);
    expect(planning.error).toBeNull();
  });
}

test("while one drags, a run may be added", async () => {
  const done = planning.follow(job(5, "RRT"));
  const first = await server.next("plan");
  void planning.follow(job(6, "RRT", "SST"));
  first.result({ length: 5 });
  (await server.next("plan")).result({ length: 6 });
  (await server.next("plan")).result({ length: 7 });
  await done;
  expect(planning.traces.map(({ length }) => length)).toEqual([6, 7]);
});
