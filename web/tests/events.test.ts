import { expect, test } from "vitest";
import { parseEvent, readEvents, type ServerEvent } from "../src/api/events";

/** A body that arrives in pieces of a few bytes. */
function inPieces(text: string, size: number): ReadableStream<Uint8Array> {
  const bytes = new TextEncoder().encode(text);
  return new ReadableStream({
    start(controller) {
      for (let i = 0; i < bytes.length; i += size) controller.enqueue(bytes.slice(i, i + size));
      controller.close();
    },
  });
}

async function all(text: string, size: number): Promise<ServerEvent[]> {
  const events: ServerEvent[] = [];
  for await (const event of readEvents(inPieces(text, size))) events.push(event);
  return events;
}

const STREAM =
  'event: progress\r\ndata: {"text": "é"}\r\n\r\n: still here\n\nevent: result\ndata: 1\ndata: 2\n\n';
const EVENTS = [
  { event: "progress", data: '{"text": "é"}' },
  { event: "result", data: "1\n2" },
];

test.each([1, 2, 7, 1000])("events arrive whole out of pieces of %i bytes", async (size) => {
  expect(await all(STREAM, size)).toEqual(EVENTS);
});

test("an event may come in many pieces", async () => {
  const data = "0123456789".repeat(10_000);
  expect(await all(`data: ${data}\n\ndata: 1\n\n`, 100)).toEqual([
    { event: "message", data },
    { event: "message", data: "1" },
  ]);
});

test("an event that was cut off is dropped", async () => {
  expect(await all("event: a\ndata: 1\n\nevent: b\ndata: 2", 5)).toEqual([
    { event: "a", data: "1" },
  ]);
});

test("who stops listening cancels the stream", async () => {
  let cancelled = false;
  const body = new ReadableStream<Uint8Array>({
    pull: (controller) => controller.enqueue(new TextEncoder().encode("data: x\n\n")),
    cancel: () => {
      cancelled = true;
    },
  });
  for await (const _ of readEvents(body)) break;
  expect(cancelled).toBe(true);
});

test("an event without a name is a message, and a comment is none", () => {
  expect(parseEvent("data:x")).toEqual({ event: "message", data: "x" });
  expect(parseEvent(": ping")).toBeNull();
});
