/** What is known of one run so far: its region, tree, path and progress. */

import type { PlanEvent, PlanResponse, Progress, RegionResponse } from "../api/types";
import { TreeLayer } from "../draw/treeLayer";

export type Phase = "waiting" | "planning" | "done" | "failed";

/** A path of this length was the best after these seconds. */
export interface Improvement {
  seconds: number;
  length: number;
}

export class Trace {
  phase: Phase = "waiting";
  readonly tree = new TreeLayer();
  region: RegionResponse | null = null;
  path: number[][] = [];
  length: number | null = null;
  vertices = 0;
  /** Of the search, without the proposal. */
  seconds = 0;
  history: Improvement[] = [];
  response: PlanResponse | null = null;

  clear(): void {
    this.tree.clear();
    this.region = null;
    this.path = [];
    this.length = null;
    this.vertices = 0;
    this.seconds = 0;
    this.history = [];
    this.response = null;
  }

  take({ event, data }: PlanEvent): void {
    if (event === "region") this.region = data;
    else if (event === "progress") this.takeProgress(data);
    else this.takeResult(data);
  }

  /** The result of a plan that was not streamed. */
  replace(response: PlanResponse): void {
    this.clear();
    this.takeResult(response);
  }

  private takeProgress({ seconds, length, vertices, path, tree }: Progress): void {
    if (path) this.path = path;
    if (tree) this.tree.add(tree);
    this.measure(seconds, length, vertices);
  }

  private takeResult(response: PlanResponse): void {
    if (response.region) this.region = response.region;
    if (response.tree) this.tree.add(response.tree);
    this.path = response.path;
    this.measure(response.planning_seconds, response.length, response.vertices);
    this.response = response;
    this.phase = "done";
  }

  private measure(seconds: number, length: number | null, vertices: number): void {
    this.seconds = seconds;
    this.vertices = vertices;
    this.length = length;
    if (length !== null && length < (this.history.at(-1)?.length ?? Number.POSITIVE_INFINITY)) {
      this.history.push({ seconds, length });
    }
  }
}
