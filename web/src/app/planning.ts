/** Plans what the page shows: at leisure with progress, or again and again while one drags. */

import { ApiError, type Client } from "../api/client";
import type { Path } from "../geometry/path";
import { type Limits, type Problem, planRequest, type Run } from "../model/problem";
import { Trace } from "./trace";

export interface Job {
  problem: Problem;
  runs: readonly Run[];
  limits: Limits;
}

/** Seconds that all runs together may search while one drags. */
const LIVE_SECONDS = 0.02;
/** Milliseconds until a busy server is asked again, and how often. */
const RETRY_AFTER = 300;
const TRIES = 10;

export class Planning {
  traces: Trace[] = [];
  /** Why there is no plan, if the server refused it. */
  error: ApiError | null = null;
  private best: { problem: Problem | null; length: number; path: Path } = none(null);
  private controller = new AbortController();
  private pending: Job | null = null;
  /** Of the loop that plans for a moment, while there is one. */
  private following: AbortSignal | null = null;

  constructor(
    private readonly client: Client,
    private readonly changed: () => void,
  ) {}

  /** The shortest path that any run has found for the present problem. */
  get bestPath(): Path {
    return this.best.path;
  }

  /** Plans with progress, the runs one after the other so that their times compare. */
  async plan(job: Job): Promise<void> {
    this.pending = null;
    const signal = this.begin(job);
    for (const trace of this.traces) trace.phase = "waiting";
    for (const [index, run] of job.runs.entries()) {
      const attempt = () => this.stream(job, run, this.traces[index]!, signal);
      if (!(await this.succeeds(attempt, signal))) return;
    }
  }

  /** Plans for a moment. While one such plan runs, only the latest wish is remembered. */
  async follow(job: Job): Promise<void> {
    this.pending = job;
    if (this.following && !this.following.aborted) return;
    const signal = this.begin(job);
    this.following = signal;
    while (this.pending && !signal.aborted) {
      const wish: Job = this.pending;
      this.pending = null;
      await this.succeeds(() => this.glance(wish, signal), signal);
    }
    if (this.following === signal) this.following = null;
  }

  private begin({ runs }: Job): AbortSignal {
    this.controller.abort();
    this.controller = new AbortController();
    this.traces = runs.map((_, index) => this.traces[index] ?? new Trace());
    return this.controller.signal;
  }

  private async stream(job: Job, run: Run, trace: Trace, signal: AbortSignal): Promise<void> {
    const request = planRequest(job.problem, run, job.limits);
    trace.phase = "planning";
    this.changed();
    let first = true;
    for await (const event of this.client.planStream(request, signal)) {
      if (signal.aborted) return;
      if (first) trace.clear(); // not earlier: what was there stays until there is something new
      first = false;
      trace.take(event);
      this.took(job, trace);
    }
  }

  private async glance(job: Job, signal: AbortSignal): Promise<void> {
    const limits = { ...job.limits, time: LIVE_SECONDS / job.runs.length };
    for (const [index, run] of job.runs.entries()) {
      const response = await this.client.plan(planRequest(job.problem, run, limits), signal);
      const trace = this.traces[index]!;
      trace.replace(response);
      this.took(job, trace);
    }
  }

  private took({ problem }: Job, { length, path }: Trace): void {
    this.error = null;
    if (problem !== this.best.problem) this.best = none(problem);
    if (length !== null && length < this.best.length) this.best = { problem, length, path };
    this.changed();
  }

  /** Tries again while the server is busy, and keeps the error if it refuses. */
  private async succeeds(attempt: () => Promise<void>, signal: AbortSignal): Promise<boolean> {
    for (let tries = 1; ; tries++) {
      try {
        await attempt();
        return !signal.aborted;
      } catch (error) {
        if (signal.aborted) return false;
        if (!(error instanceof ApiError)) throw error;
        if (error.status !== 429 || tries === TRIES) {
          this.fail(error);
          return false;
        }
        await new Promise((resolve) => setTimeout(resolve, RETRY_AFTER));
      }
    }
  }

  private fail(error: ApiError): void {
    this.error = error;
    this.best = none(null);
    for (const trace of this.traces) {
      trace.clear();
      trace.phase = "failed";
    }
    this.changed();
  }
}

function none(problem: Problem | null) {
  return { problem, length: Number.POSITIVE_INFINITY, path: [] as Path };
}
