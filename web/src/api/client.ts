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

/** What the server refused, in its words. */
export class ApiError extends Error {
  readonly kind: string;
  readonly nearestFree: [number, number] | undefined;

  constructor(
    readonly status: number,
    body: ErrorBody,
  ) {
    super(body.message);
    this.kind = body.error;
    this.nearestFree = body.details?.nearest_free;
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
    return (await this.send(`maps/${id}/image`)).blob();
  }

  imageUrl(id: string): string {
    return this.url(`maps/${id}/image`);
  }

  plan(request: PlanRequest, signal: AbortSignal): Promise<PlanResponse> {
    return this.json("plan", { ...post(request), signal });
  }

  async *planStream(request: PlanRequest, signal: AbortSignal): AsyncGenerator<PlanEvent> {
    const response = await this.send("plan/stream", { ...post(request), signal });
    for await (const { event, data } of readEvents(response.body!)) {
      const value = JSON.parse(data);
      if (event === "error") throw new ApiError(response.status, value);
      yield { event, data: value } as PlanEvent;
    }
  }

  private url(path: string): string {
    return new URL(path, this.base).href;
  }

  private async json<T>(path: string, init?: RequestInit): Promise<T> {
    return (await this.send(path, init)).json() as Promise<T>;
  }

  private async send(path: string, init?: RequestInit): Promise<Response> {
    const response = await fetch(this.url(path), init).catch((error: unknown) => {
      if (init?.signal?.aborted) throw error;
      throw new ApiError(0, {
        error: "Unreachable",
        message: "The server does not answer. Is `planformer serve` still running?",
      });
    });
    if (!response.ok) throw new ApiError(response.status, await errorBody(response));
    return response;
  }
}

function post(value: unknown): RequestInit {
  return {
    method: "POST",
    headers: { "content-type": "application/json" },
    body: JSON.stringify(value),
  };
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
