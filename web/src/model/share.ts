/** A problem as the fragment of a link, short and readable, for example
 * `#map=forest,3,24,24,0.05&id=0123456789abcdef&robot=dubins,0.2,0.55&start=2,2,0&goal=20,21,1.57&run=RRTstar,mpt,0&time=1`.
 */

import type { MapKind, RobotKind, Stroke } from "../api/types";
import type { Pose } from "../geometry/points";
import { rounded } from "../geometry/points";
import type { Limits, MapSource, RobotModel, Run } from "./problem";

export interface Shared {
  source: MapSource;
  /** The map's id: tells whether a map that was generated again is the same. */
  id: string;
  robot: RobotModel;
  start: Pose;
  goal: Pose;
  runs: Run[];
  limits: Limits;
}

const KINDS: readonly string[] = ["forest", "maze", "indoor"] satisfies MapKind[];
const ROBOTS: readonly string[] = ["point", "dubins", "reeds-shepp"] satisfies RobotKind[];
const UNGUIDED = "none";
const MOST_SEED = 2 ** 32 - 1;

export function encode({ source, id, robot, start, goal, runs, limits }: Shared): string {
  const fields: [string, string][] = [];
  if (source.kind === "generated") {
    const { kind, seed, width, height, resolution } = source.request;
    fields.push(["map", `${kind},${seed},${width},${height},${resolution}`]);
    if (source.strokes.length > 0) fields.push(["edits", source.strokes.map(strokeText).join("~")]);
  }
  fields.push(["id", id]);
  fields.push(["robot", `${robot.kind},${robot.radius},${robot.turningRadius}`]);
  fields.push(["start", poseText(start)], ["goal", poseText(goal)]);
  for (const { planner, guide, exploration } of runs) {
    fields.push([
      "run",
      `${encodeURIComponent(planner)},${encodeURIComponent(guide ?? UNGUIDED)},${exploration}`,
    ]);
  }
  fields.push(["time", String(limits.time)]);
  if (limits.seed !== null) fields.push(["seed", String(limits.seed)]);
  return `#${fields.map(([key, value]) => `${key}=${value}`).join("&")}`;
}

/** Null where the fragment holds no problem, or a damaged one; `longest` bounds its time limit. */
export function decode(fragment: string, longest: number): Shared | null {
  const fields = new URLSearchParams(fragment.replace(/^#/, ""));
  try {
    return {
      source: sourceOf(fields),
      id: /^[0-9a-f]{16}$/.exec(fields.get("id") ?? "")?.[0] ?? fail("id"),
      robot: robotOf(fields.get("robot") ?? ""),
      start: poseOf(fields.get("start") ?? ""),
      goal: poseOf(fields.get("goal") ?? ""),
      runs: fields.getAll("run").map(runOf),
      limits: {
        time: Math.min(positive(fields.get("time") ?? ""), longest),
        seed: fields.has("seed") ? whole(fields.get("seed")!, MOST_SEED) : null,
      },
    };
  } catch (error) {
    if (error instanceof Damaged) return null;
    throw error;
  }
}

/** A stroke whose coordinates survive a link. */
export function exactStroke({ points, radius, occupied }: Stroke): Stroke {
  return {
    points: points.map(([x, y]) => [rounded(x, 2), rounded(y, 2)]),
    radius: rounded(radius, 3),
    occupied,
  };
}

class Damaged extends Error {}

function fail(field: string): never {
  throw new Damaged(field);
}

function number(text: string): number {
  const value = Number(text);
  return text.trim() !== "" && Number.isFinite(value) ? value : fail(text);
}

function within(text: string, least: number, most: number): number {
  const value = number(text);
  return value >= least && value <= most ? value : fail(text);
}

function positive(text: string): number {
  return within(text, Number.MIN_VALUE, Number.MAX_VALUE);
}

function whole(text: string, most: number): number {
  const value = within(text, 0, most);
  return Number.isInteger(value) ? value : fail(text);
}

function poseText({ x, y, yaw }: Pose): string {
  return `${x},${y},${yaw}`;
}

function poseOf(text: string): Pose {
  const [x, y, yaw] = text.split(",").map(number);
  if (yaw === undefined) fail("pose");
  return { x: x!, y: y!, yaw };
}

function strokeText({ points, radius, occupied }: Stroke): string {
  return [`${occupied ? "w" : "e"}${radius}`, ...points.flat()].join(",");
}

function strokeOf(text: string): Stroke {
  const [brush, ...rest] = text.split(",");
  const values = rest.map(number);
  if (!/^[we]/.test(brush!) || values.length < 2 || values.length % 2 !== 0) fail("edits");
  const points: [number, number][] = [];
  for (let i = 0; i < values.length; i += 2) points.push([values[i]!, values[i + 1]!]);
  return { points, radius: number(brush!.slice(1)), occupied: brush!.startsWith("w") };
}

function sourceOf(fields: URLSearchParams): MapSource {
  const map = fields.get("map");
  if (map === null) return { kind: "stored" };
  const [kind, seed, width, height, resolution] = map.split(",");
  if (resolution === undefined || !KINDS.includes(kind!)) fail("map");
  const edits = fields.get("edits");
  return {
    kind: "generated",
    request: {
      kind: kind as MapKind,
      seed: whole(seed!, Number.MAX_SAFE_INTEGER),
      width: number(width!),
      height: number(height!),
      resolution: number(resolution),
    },
    strokes: edits === null ? [] : edits.split("~").map(strokeOf),
  };
}

function robotOf(text: string): RobotModel {
  const [kind, radius, turningRadius] = text.split(",");
  if (turningRadius === undefined || !ROBOTS.includes(kind!)) fail("robot");
  return {
    kind: kind as RobotKind,
    radius: within(radius!, 0, Number.MAX_VALUE),
    turningRadius: positive(turningRadius),
  };
}

function runOf(text: string): Run {
  const [planner, guide, exploration] = text.split(",");
  if (exploration === undefined) fail("run");
  return {
    planner: planner!,
    guide: guide === UNGUIDED ? null : guide!,
    exploration: within(exploration, 0, 1),
  };
}
