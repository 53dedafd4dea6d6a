/** A found path as the files that `planformer plan` writes. */

import type { PlanResponse } from "../api/types";
import { type Limits, type Problem, type Run, wireRobot, wireState } from "./problem";

export function pathCsv({ path }: PlanResponse): string {
  const header = (path[0] ?? []).length > 2 ? "x,y,yaw" : "x,y";
  return `${[header, ...path.map((state) => state.join(","))].join("\n")}\n`;
}

export function pathJson(
  problem: Problem,
  run: Run,
  limits: Limits,
  response: PlanResponse,
): string {
  const { solved, status, length, vertices, planning_seconds, proposal_seconds, seed } = response;
  const { map, robot, start, goal } = problem;
  const record = {
    solved,
    status,
    length,
    vertices,
    planning_seconds,
    proposal_seconds,
    planner: run.planner,
    guide: run.guide,
    exploration: run.exploration,
    time_limit: limits.time,
    seed,
    start: wireState(robot, start),
    goal: wireState(robot, goal),
    robot: wireRobot(robot),
    map: {
      id: map.id,
      name: map.name,
      shape: [map.rows, map.columns],
      resolution: map.resolution,
      origin: map.origin,
    },
    path: response.path,
  };
  return `${JSON.stringify(record, null, 2)}\n`;
}
