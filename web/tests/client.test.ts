import { afterEach, describe, expect, test, vi } from "vitest";
import { Client } from "../src/api/client";
import type { PlanRequest } from "../src/api/types";

const client = new Client("http://server/");
const REQUEST: PlanRequest = {
  map: "0123456789abcdef",
  robot: { kind: "point", radius: 0.1 },
  start: [1, 1],
  goal: [2, 2],
  planner: "RRTstar",
  guide: null,
  exploration: 0,
  time_limit: 1,
  tree: true,
  region: false,
};

afterEach(() => {
  vi.unstubAllGlobals();
});

/** Lets the server answer so, one request after the other; gives the seconds waited in between. */
function answering(...answers: Response[]): number[] {
  const waits: number[] = [];
  vi.stubGlobal("fetch", async () => answers.shift());
  vi.stubGlobal("setTimeout", (wake: () => void, milliseconds: number) => {
    waits.push(milliseconds / 1000);
    queueMicrotask(wake);
  });
  return waits;
}

function refusal(status: number, headers: Record<string, string> = {}): Response {
  return Response.json({ error: "Refused", message: "no" }, { status, headers });
}

/** An answer that breaks off after a text. */
function brokenOff(text: string): Response {
  const pieces = [new TextEncoder().encode(text)];
  const body = new ReadableStream<Uint8Array>({
    pull: (controller) => {
      const piece = pieces.shift();
      if (piece) controller.enqueue(piece);
      else controller.error(new TypeError("network error"));
    },
  });
  return new Response(body);
}

async function streamed(): Promise<string[]> {
  const names: string[] = [];
  const events = client.planStream(REQUEST, new AbortController().signal);
  for await (const { event } of events) names.push(event);
  return names;
}

describe("a busy server", () => {
  test("is asked again when it says, or after a second", async () => {
    const waits = answering(refusal(429, { "retry-after": "2" }), refusal(503), Response.json([]));
    expect(await client.maps()).toEqual([]);
    expect(waits).toEqual([2, 1]);
  });

  test("is not asked for ever", async () => {
    const waits = answering(...Array.from({ length: 100 }, () => refusal(429)));
    await expect(client.maps()).rejects.toMatchObject({ status: 429, isTransient: true });
    expect(waits.length).toBeGreaterThan(3);
    expect(waits.length).toBeLessThan(100);
  });

  test("that wants to be left alone for long is not waited for", async () => {
    const waits = answering(refusal(503, { "retry-after": "3600" }));
    await expect(client.maps()).rejects.toMatchObject({ status: 503, retryAfter: 3600 });
    expect(waits).toEqual([]);
  });

  test("is not asked again for a plan that is for a moment", async () => {
    const waits = answering(refusal(429, { "retry-after": "1" }));
    const plan = client.plan(REQUEST, new AbortController().signal);
    await expect(plan).rejects.toMatchObject({ status: 429, retryAfter: 1 });
    expect(waits).toEqual([]);
  });
});

test("a refusal is final", async () => {
  const waits = answering(refusal(400, { "retry-after": "1" }));
  await expect(client.maps()).rejects.toMatchObject({ status: 400, isTransient: false });
  expect(waits).toEqual([]);
});

describe("an answer that breaks off", () => {
  const gone = { kind: "Unreachable", isTransient: true };

  test("is an error, whatever was to come", async () => {
    answering(brokenOff('[{"id":'), brokenOff("PNG"));
    await expect(client.maps()).rejects.toMatchObject(gone);
    await expect(client.image("0123456789abcdef")).rejects.toMatchObject(gone);
  });

  test("is an error, even if it seems to end", async () => {
    answering(new Response('[{"id":'), new Response("event: progress\ndata: {}\n\n"));
    await expect(client.maps()).rejects.toMatchObject(gone);
    await expect(streamed()).rejects.toMatchObject(gone);
  });

  test("is an error in the middle of a plan, and none after its result", async () => {
    answering(
      brokenOff("event: progress\ndata: {}\n\n"),
      brokenOff("event: progress\ndata: {}\n\nevent: result\ndata: {}\n\n"),
    );
    await expect(streamed()).rejects.toMatchObject(gone);
    expect(await streamed()).toEqual(["progress", "result"]);
  });
});

test("an error in a stream is told in the server's words", async () => {
  const body = 'event: error\ndata: {"error": "StartOccupied", "message": "in collision"}\n\n';
  answering(new Response(body));
  await expect(streamed()).rejects.toMatchObject({ kind: "StartOccupied", isTransient: false });
});

test("who gives a request up hears nothing of the server", async () => {
  const controller = new AbortController();
  controller.abort();
  vi.stubGlobal("fetch", async (_: string, { signal }: RequestInit) => signal?.throwIfAborted());
  await expect(client.plan(REQUEST, controller.signal)).rejects.toMatchObject({
    name: "AbortError",
  });
});
