/** A server in the place of `fetch`: the tests write its answers, and choose when they come. */

import { vi } from "vitest";
import type { MapInfo, PlanResponse } from "../src/api/types";

const BASE = "http://server/";
const SIDE = 20;

const RESULT: PlanResponse = {
  solved: true,
  status: "time limit",
  path: [
    [1, 1],
    [2, 2],
  ],
  length: 10,
  vertices: 5,
  planning_seconds: 0.1,
  proposal_seconds: 0,
  total_seconds: 0.1,
  planner: "RRTstar",
  guide: null,
  seed: 1,
  region: null,
  tree: null,
};

/** A request that waits for its answer. */
export class Asked {
  constructor(
    readonly path: string,
    readonly body: unknown,
    private readonly respond: (response: Response) => void,
  ) {}

  json(value: unknown): void {
    this.respond(Response.json(value));
  }

  /** Answers with a plan, whole or as a stream. */
  result(change: Partial<PlanResponse>): void {
    const result = { ...RESULT, ...change };
    if (this.path === "plan") this.json(result);
    else this.respond(new Response(`event: result\ndata: ${JSON.stringify(result)}\n\n`));
  }

  refuse(status: number, message: string, headers: Record<string, string> = {}): void {
    this.respond(Response.json({ error: "Refused", message }, { status, headers }));
  }

  /** The server dies while it answers. */
  breakOff(): void {
    const body = new ReadableStream({
      pull: (controller) => controller.error(new TypeError("network error")),
    });
    this.respond(new Response(body));
  }
}

export class FakeServer {
  readonly base = BASE;
  /** What was asked for, in this order; pictures of maps are answered and not counted. */
  readonly paths: string[] = [];
  private waiting: Asked[] = [];
  private expected: { path: string; tell: (asked: Asked) => void }[] = [];

  constructor() {
    vi.stubGlobal("fetch", (url: string, init?: RequestInit) => this.fetch(url, init));
  }

  /** The next request for a path: one that waits, or one that is yet to come. */
  next(path: string): Promise<Asked> {
    const asked = this.waiting.find((other) => other.path === path);
    if (!asked) return new Promise((tell) => this.expected.push({ path, tell }));
    this.forget(asked);
    return Promise.resolve(asked);
  }

  private fetch(url: string, { body, signal }: RequestInit = {}): Promise<Response> {
    const path = url.slice(BASE.length);
    if (path.endsWith("/image")) return Promise.resolve(new Response("picture"));
    this.paths.push(path);
    return new Promise((respond, reject) => {
      signal?.throwIfAborted();
      const asked = new Asked(path, typeof body === "string" ? JSON.parse(body) : null, respond);
      signal?.addEventListener("abort", () => {
        this.forget(asked);
        reject(signal?.reason);
      });
      this.offer(asked);
    });
  }

  private offer(asked: Asked): void {
    const expected = this.expected.find(({ path }) => path === asked.path);
    this.expected = this.expected.filter((other) => other !== expected);
    if (expected) expected.tell(asked);
    else this.waiting.push(asked);
  }

  private forget(asked: Asked): void {
    this.waiting = this.waiting.filter((other) => other !== asked);
  }
}

export function mapInfo(id: string): MapInfo {
  return {
    id,
    name: id,
    rows: SIDE,
    columns: SIDE,
    resolution: 0.5,
    origin: [0, 0, 0],
    width: SIDE / 2,
    height: SIDE / 2,
    occupied: 0,
    source: null,
  };
}

/** Stands in for the browser's pictures: every map is free all over. */
export function stubPictures(): void {
  const size = { width: SIDE, height: SIDE };
  const data = new Uint8ClampedArray(4 * SIDE * SIDE).fill(255);
  const context = { drawImage: () => {}, getImageData: () => ({ ...size, data }) };
  vi.stubGlobal("createImageBitmap", async () => ({ ...size, close: () => {} }));
  vi.stubGlobal(
    "OffscreenCanvas",
    class {
      getContext() {
        return context;
      }
    },
  );
}
