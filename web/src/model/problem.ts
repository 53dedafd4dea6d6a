/** What is planned: a map, a robot, start and goal; and how: the runs that are compared. */

import type { GenerateRequest, MapInfo, PlanRequest, Robot, RobotKind, Stroke } from "../api/types";
import { type Pose, rounded } from "../geometry/points";

/** Where a map came from, as far as it can be made again. */
export type MapSource =
  | { kind: "generated"; request: GenerateRequest; strokes: Stroke[] }
  | { kind: "stored" };

export interface RobotModel {
  kind: RobotKind;
  radius: number;
  /** Kept, but not used, while the robot is a point. */
  turningRadius: number;
}

export interface Problem {
  map: MapInfo;
  source: MapSource;
  robot: RobotModel;
  start: Pose;
  goal: Pose;
}

/** One planner of a comparison. */
export interface Run {
  planner: string;
  guide: string | null;
  /** Share of the samples drawn outside the region, 0 to 1. */
  exploration: number;
}

export function runName({ planner, guide }: Run): string {
  return guide === null ? planner : `${planner} · ${guide}`;
}

export interface Limits {
  /** Seconds. */
  time: number;
  /** Null for a new seed each time. */
  seed: number | null;
}

export function isCar(robot: RobotModel): boolean {
  return robot.kind !== "point";
}

export function wireRobot({ kind, radius, turningRadius }: RobotModel): Robot {
  return kind === "point" ? { kind, radius } : { kind, radius, turning_radius: turningRadius };
}

export function wireState(robot: RobotModel, { x, y, yaw }: Pose): number[] {
  return isCar(robot) ? [x, y, yaw] : [x, y];
}

/** A pose in whole millimetres and tenths of a milliradian, so that links and snippets are exact. */
export function exactPose({ x, y, yaw }: Pose): Pose {
  return { x: rounded(x, 3), y: rounded(y, 3), yaw: rounded(yaw, 4) };
}

export function planRequest(problem: Problem, run: Run, limits: Limits): PlanRequest {
  const { map, robot, start, goal } = problem;
  return {
    map: map.id,
    robot: wireRobot(robot),
    start: wireState(robot, start),
    goal: wireState(robot, goal),
    planner: run.planner,
    guide: run.guide,
    exploration: run.guide === null ? 0 : run.exploration,
    time_limit: limits.time,
    ...(limits.seed === null ? {} : { seed: limits.seed }),
    tree: true,
    region: run.guide !== null,
  };
}
