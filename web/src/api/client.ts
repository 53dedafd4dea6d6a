/** Calls of the server's HTTP API. */

import { readEvents } from "./events";
import type {
  ErrorBody,
  GenerateRequest,
  MapInfo,
  Options,
  PlanEvent,
  PlanRequest,
  PlanResponse,
  Stroke,
} from "./types";

/** Seconds for which a busy server is asked again. */
const PATIENCE = 12;

/** Why something cannot be had: in the server's words, or the page's where it has none. */
export class ApiError extends Error {
  readonly kind: string;
  readonly nearestFree: [number, number] | undefined;

  constructor(
    /** Of the response; 0 if none came, or not all of it. */
    readonly status: number,
    body: ErrorBody,
    /** Seconds after which a busy server may be asked again; null if it is not busy. */
    readonly retryAfter: number | null = null,
  ) {
    super(body.message);
    this.kind = body.error;
    this.nearestFree = body.details?.nearest_free;
  }

  /** Whether the same may be had later. */
  get isTransient(): boolean {
    return this.status === 0 || this.retryAfter !== null;
  }
}

export class Client {
  constructor(private readonly base: string) {}

  options(): Promise<Options> {
    return this.json("options");
  }

  maps(): Promise<MapInfo[]> {
    return this.json("maps");
  }

  map(id: string): Promise<MapInfo> {
    return this.json(`maps/${encodeURIComponent(id)}`);
  }

  generate(request: GenerateRequest): Promise<MapInfo> {
    return this.json("maps/generate", post(request));
  }

  edit(id: string, strokes: Stroke[]): Promise<MapInfo> {
    return this.json(`maps/${id}/edit`, post({ strokes }));
  }

  upload(files: Iterable<File>, resolution: number | null): Promise<MapInfo> {
    const body = new FormData();
    for (const file of files) body.append("files", file);
    if (resolution !== null) body.append("resolution", String(resolution));
    return this.json("maps", { method: "POST", body });
  }

  async image(id: string): Promise<Blob> {
    return arrived((await this.send(`maps/${id}/image`)).blob());
  }

  imageUrl(id: string): string {
    return this.url(`maps/${id}/image`);
  }

  /** A busy server is not asked again: by then, another plan may be wanted. */
  plan(request: PlanRequest, signal: AbortSignal): Promise<PlanResponse> {
    return this.json("plan", { ...post(request), signal }, 0);
  }

  /** The events of a plan, the last of which is its result. */
  async *planStream(request: PlanRequest, signal: AbortSignal): AsyncGenerator<PlanEvent> {
    const response = await this.send("plan/stream", { ...post(request), signal });
    try {
      for await (const { event, data } of readEvents(response.body!)) {
        const value = JSON.parse(data);
        if (event === "error") throw new ApiError(response.status, value);
        yield { event, data: value } as PlanEvent;
        if (event === "result") return;
      }
    } catch (error) {
      throw failure(error, signal);
    }
    throw unreachable();
  }

  private url(path: string): string {
    return new URL(path, this.base).href;
  }

  private async json<T>(path: string, init?: RequestInit, patience = PATIENCE): Promise<T> {
    const response = await this.send(path, init, patience);
    return arrived(response.json() as Promise<T>, init?.signal);
  }

  /** Asks, and asks a busy server again for `patience` seconds at most. */
  private async send(path: string, init?: RequestInit, patience = PATIENCE): Promise<Response> {
    const response = await arrived(fetch(this.url(path), init), init?.signal);
    if (response.ok) return response;
    const error = new ApiError(response.status, await errorBody(response), retryAfter(response));
    if (error.retryAfter === null || error.retryAfter > patience) throw error;
    await pause(error.retryAfter);
    return this.send(path, init, patience - error.retryAfter);
  }
}

export function pause(seconds: number): Promise<void> {
  return new Promise((resolve) => setTimeout(resolve, 1000 * seconds));
}

function post(value: unknown): RequestInit {
  return {
    method: "POST",
    headers: { "content-type": "application/json" },
    body: JSON.stringify(value),
  };
}

/** A response or its body, whose loss is an error that the page can tell of. */
async function arrived<T>(coming: Promise<T>, signal?: AbortSignal | null): Promise<T> {
  try {
    return await coming;
  } catch (error) {
    throw failure(error, signal);
  }
}

/** What a request failed with: it was given up or refused, or else the server is gone. */
function failure(error: unknown, signal?: AbortSignal | null): unknown {
  return signal?.aborted || error instanceof ApiError ? error : unreachable();
}

function unreachable(): ApiError {
  return new ApiError(0, {
    error: "Unreachable",
    message: "The server does not answer. Is `planformer serve` still running?",
  });
}

/** Seconds after which a busy server may be asked again: one, where it does not say. */
function retryAfter({ status, headers }: Response): number | null {
  if (status !== 429 && status !== 503) return null;
  return Math.max(1, Number(headers.get("retry-after")) || 1);
}

async function errorBody(response: Response): Promise<ErrorBody> {
  try {
    const body = (await response.json()) as ErrorBody;
    if (typeof body.message === "string") return body;
  } catch {
    // Not JSON, for example from a proxy.
  }
  const message = `The server answered ${response.status} ${response.statusText}.`;
  return { error: "HttpError", message };
}
