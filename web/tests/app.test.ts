import { afterEach, beforeEach, describe, expect, test, vi } from "vitest";
import { Client } from "../src/api/client";
import type { Options, RobotOptions, Stroke } from "../src/api/types";
import { App } from "../src/app/app";
import { encode } from "../src/model/share";
import { FakeServer, mapInfo, stubPictures } from "./server";

const ROBOT: RobotOptions = {
  planners: ["RRTstar", "SST"],
  guides: ["mpt"],
  default_planner: "RRTstar",
  default_guide: "mpt",
  unguided_planners: [],
};
const OPTIONS: Options = {
  version: "0",
  robots: { point: ROBOT, dubins: ROBOT, "reeds-shepp": ROBOT },
  limits: { plan_seconds: 10, runs_to_compare: 4 },
};

const ID = "0123456789abcdef";
const LINK = encode({
  source: { kind: "stored" },
  id: ID,
  robot: { kind: "point", radius: 0.1, turningRadius: 0.55 },
  start: { x: 1, y: 1, yaw: 0 },
  goal: { x: 9, y: 9, yaw: 0 },
  runs: [{ planner: "RRTstar", guide: "mpt", exploration: 0 }],
  limits: { time: 1, seed: null },
});
const POSE = { x: 3, y: 3, yaw: 0 };

let server: FakeServer;

beforeEach(() => {
  server = new FakeServer();
  stubPictures();
});

afterEach(() => {
  vi.unstubAllGlobals();
});

function newApp(): App {
  return new App(new Client(server.base), OPTIONS, () => {});
}

/** An application that shows a map. */
async function opened(id: string): Promise<App> {
  const app = newApp();
  await app.open(mapInfo(id));
  return app;
}

function shown(app: App): string | undefined {
  return app.store.current.problem?.map.id;
}

function stroke(): Stroke {
  return { points: [[1, 1]], radius: 0.25, occupied: true };
}

/** Waits for what comes of an answer. */
function eventually(check: () => void): Promise<void> {
  return vi.waitFor(check, { timeout: 4000 });
}

describe("drawing", () => {
  test("on a map that was left meanwhile changes nothing", async () => {
    const app = await opened("a");
    app.draw(stroke());
    app.draw(stroke());
    const edit = await server.next("maps/a/edit");
    await app.open(mapInfo("b"));
    expect(app.strokes).toEqual([]);
    edit.json(mapInfo("a1"));
    app.draw(stroke());
    await server.next("maps/b/edit"); // after those of the former map
    expect(shown(app)).toBe("b");
    expect(app.canUndo).toBe(false);
    const edits = server.paths.filter((path) => path.endsWith("/edit"));
    expect(edits).toEqual(["maps/a/edit", "maps/b/edit"]);
  });

  test("goes on while another map is awaited, and when that is refused", async () => {
    const app = await opened("a");
    const generated = app.generate("maze", 1, 24);
    app.draw(stroke());
    (await server.next("maps/a/edit")).json(mapInfo("a1"));
    await eventually(() => expect(shown(app)).toBe("a1"));
    (await server.next("maps/generate")).refuse(400, "no such map");
    await generated;
    expect(shown(app)).toBe("a1");
    expect(app.mapError?.message).toBe("no such map");
  });

  test("goes on after a stroke whose answer broke off", async () => {
    const app = await opened("a");
    app.draw(stroke());
    (await server.next("maps/a/edit")).breakOff();
    app.draw(stroke());
    const edit = await server.next("maps/a/edit");
    expect(app.mapError?.kind).toBe("Unreachable");
    expect(app.strokes).toHaveLength(1);
    edit.json(mapInfo("a1"));
    await eventually(() => expect(shown(app)).toBe("a1"));
    expect(app.mapError).toBeNull();
  });

  test("is undone after the server has answered", async () => {
    const app = await opened("a");
    const ids: (string | undefined)[] = [];
    app.store.subscribe(() => ids.push(shown(app)));
    app.draw(stroke());
    const edit = await server.next("maps/a/edit");
    app.undo();
    edit.json(mapInfo("a1"));
    await eventually(() => expect(ids).toEqual(["a1", "a"]));
    expect(app.canUndo).toBe(false);
  });

  test("can be undone for a number of strokes", async () => {
    const app = await opened("0");
    for (let count = 1; count <= 25; count++) {
      app.draw(stroke());
      (await server.next(`maps/${count - 1}/edit`)).json(mapInfo(String(count)));
    }
    for (let count = 1; count <= 25; count++) app.undo();
    await eventually(() => expect([app.canUndo, shown(app)]).toEqual([false, "5"]));
  });
});

describe("a link", () => {
  test("that is slow does not replace a map that was asked for later", async () => {
    const app = newApp();
    const begun = app.begin(LINK);
    const slow = await server.next(`maps/${ID}`);
    await app.open(mapInfo("b"));
    slow.json(mapInfo(ID));
    await begun;
    expect(shown(app)).toBe("b");
  });

  test("is not replaced by a map that was asked for earlier", async () => {
    const app = newApp();
    const generated = app.generate("maze", 1, 24);
    const slow = await server.next("maps/generate");
    const begun = app.begin(LINK);
    (await server.next(`maps/${ID}`)).json(mapInfo(ID));
    await begun;
    slow.json(mapInfo("b"));
    await generated;
    expect(shown(app)).toBe(ID);
  });

  test("that is damaged is told of, beside the first problem", async () => {
    const app = newApp();
    const begun = app.begin("#map=jungle");
    (await server.next("maps/generate")).json(mapInfo("first"));
    await begun;
    expect(shown(app)).toBe("first");
    expect(app.mapError?.message).toContain("damaged");
    expect(app.mapError?.isTransient).toBe(false);
  });

  test("whose map cannot be had for now is told of as such", async () => {
    const app = newApp();
    const begun = app.begin(LINK);
    (await server.next(`maps/${ID}`)).refuse(503, "back soon", { "retry-after": "60" });
    (await server.next("maps/generate")).json(mapInfo("first"));
    await begun;
    expect(shown(app)).toBe("first");
    expect(app.mapError?.isTransient).toBe(true);
  });
});

test("a newer error with a plan takes the place of one with a map", async () => {
  const app = await opened("a");
  const uploaded = app.upload([], null);
  (await server.next("maps")).refuse(400, "no picture");
  await uploaded;
  expect(app.mapError?.message).toBe("no picture");
  (await server.next("plan/stream")).refuse(400, "in collision");
  await eventually(() => expect(app.planning.error?.message).toBe("in collision"));
  expect(app.mapError).toBeNull();
});

test("a result is that of the present problem, or there is none", async () => {
  const app = await opened("a");
  (await server.next("plan/stream")).result({ length: 7 });
  await eventually(() => expect(app.result(0)?.length).toBe(7));
  app.moveEnd("goal", POSE, false);
  expect(app.result(0)).toBeNull();
  (await server.next("plan/stream")).result({ length: 6 });
  await eventually(() => expect(app.result(0)?.length).toBe(6));
  app.moveEnd("goal", POSE, true);
  expect(app.result(0)).toBeNull();
});

const ACTIONS: Record<string, (app: App) => void> = {
  "to plan again": (app) => app.planAgain(),
  "another time limit": (app) => app.setLimits({ time: 2 }),
  "another guide": (app) => app.setRun(0, { guide: null }),
  "one more planner": (app) => app.addRun(),
};

for (const [name, act] of Object.entries(ACTIONS)) {
  test(`who wants ${name} in a drag gets a whole plan`, async () => {
    const app = await opened("a");
    app.moveEnd("goal", POSE, true);
    act(app);
    expect(app.store.current.live).toBe(false);
    await server.next("plan/stream");
  });
}
