/** Plans what the page shows: at leisure with progress, or again and again while one drags. */

import { ApiError, type Client, pause } from "../api/client";
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

export class Planning {
  traces: Trace[] = [];
  private refusal: { job: Job; error: ApiError } | null = null;
  private best: { problem: Problem | null; length: number; path: Path } = none(null);
  private controller = new AbortController();
  private pending: Job | null = null;
  /** Of the loop that plans for a moment, while there is one. */
  private following: AbortSignal | null = null;

  constructor(
    private readonly client: Client,
    private readonly changed: () => void,
    private readonly refused: () => void,
  ) {}

  /** Why a run has no plan, until one of a later job has. */
  get error(): ApiError | null {
    return this.refusal?.error ?? null;
  }

  /** The shortest path that any run has found for the present problem. */
  get bestPath(): Path {
    return this.best.path;
  }

  /** Plans with progress, the runs one after the other so that their times compare. */
  async plan(job: Job): Promise<void> {
    this.pending = null;
    const signal = this.begin();
    const traces = this.match(job);
    for (const trace of traces) trace.phase = "waiting";
    for (const [index, run] of job.runs.entries()) {
      await this.stream(job, run, traces[index]!, signal);
      if (signal.aborted) return;
    }
  }

  /** Plans for a moment. While one such plan runs, only the latest wish is remembered. */
  async follow(job: Job): Promise<void> {
    this.pending = job;
    if (this.following && !this.following.aborted) return;
    const signal = this.begin();
    this.following = signal;
    while (this.pending && !signal.aborted) {
      const wish: Job = this.pending;
      this.pending = null;
      await this.glance(wish, signal);
    }
    if (this.following === signal) this.following = null;
  }

  private begin(): AbortSignal {
    this.controller.abort();
    this.controller = new AbortController();
    return this.controller.signal;
  }

  /** A trace for each run: that which it had, or a new one. */
  private match({ runs }: Job): Trace[] {
    this.traces = runs.map((_, index) => this.traces[index] ?? new Trace());
    return this.traces;
  }

  private async stream(job: Job, run: Run, trace: Trace, signal: AbortSignal): Promise<void> {
    const request = planRequest(job.problem, run, job.limits);
    trace.phase = "planning";
    this.changed();
    let first = true;
    try {
      for await (const event of this.client.planStream(request, signal)) {
        if (signal.aborted) return;
        if (first) trace.clear(); // not earlier: what was there stays until there is something new
        first = false;
        trace.take(event);
        this.took(job, trace);
      }
    } catch (error) {
      if (!signal.aborted) this.fail(job, trace, error);
    }
  }

  private async glance(job: Job, signal: AbortSignal): Promise<void> {
    const limits = { ...job.limits, time: LIVE_SECONDS / job.runs.length };
    const traces = this.match(job);
    for (const [index, run] of job.runs.entries()) {
      const trace = traces[index]!;
      try {
        const response = await this.client.plan(planRequest(job.problem, run, limits), signal);
        if (signal.aborted) return;
        trace.replace(response);
        this.took(job, trace);
      } catch (error) {
        if (signal.aborted) return;
        if (isBusy(error)) return this.wait(job, error.retryAfter);
        this.fail(job, trace, error);
      }
    }
  }

  /** Leaves a busy server alone; then it is asked for the latest wish, which may still be this. */
  private wait(job: Job, seconds: number): Promise<void> {
    this.pending ??= job;
    return pause(seconds);
  }

  private took(job: Job, { length, path }: Trace): void {
    if (this.refusal?.job !== job) this.refusal = null;
    this.turnTo(job.problem);
    if (length !== null && length < this.best.length) this.best = { ...this.best, length, path };
    this.changed();
  }

  /** Keeps the error of one run, and what the others have found. */
  private fail(job: Job, trace: Trace, error: unknown): void {
    if (!(error instanceof ApiError)) throw error;
    trace.clear();
    trace.phase = "failed";
    this.turnTo(job.problem);
    this.refusal = { job, error };
    this.refused();
    this.changed();
  }

  /** Forgets the best path of another problem. */
  private turnTo(problem: Problem): void {
    if (problem !== this.best.problem) this.best = none(problem);
  }
}

function isBusy(error: unknown): error is ApiError & { retryAfter: number } {
  return error instanceof ApiError && error.retryAfter !== null;
}

function none(problem: Problem | null) {
  return { problem, length: Number.POSITIVE_INFINITY, path: [] as Path };
}
