/** Server-sent events out of a response's body. (EventSource cannot send a POST request.) */

export interface ServerEvent {
  event: string;
  data: string;
}

export async function* readEvents(body: ReadableStream<Uint8Array>): AsyncGenerator<ServerEvent> {
  const reader = body.getReader();
  const decoder = new TextDecoder();
  let pieces: string[] = []; // of an event that has not ended
  let tail = ""; // the last character: the blank line at an event's end may come in two pieces
  try {
    while (true) {
      const { done, value } = await reader.read();
      if (done) return;
      const piece = decoder.decode(value, { stream: true }).replaceAll("\r", "");
      pieces.push(piece);
      const ended = (tail + piece).includes("\n\n");
      tail = piece.at(-1) ?? tail;
      if (!ended) continue; // and what came before is not looked at again
      const blocks = pieces.join("").split("\n\n");
      pieces = [blocks.pop()!];
      for (const block of blocks) {
        const event = parseEvent(block);
        if (event) yield event;
      }
    }
  } finally {
    await reader.cancel().catch(() => {}); // tells the server that nobody listens any more
  }
}

export function parseEvent(block: string): ServerEvent | null {
  let event = "message";
  const data: string[] = [];
  for (const line of block.split("\n")) {
    const [, field, value] = /^([^:]+): ?(.*)$/.exec(line) ?? [];
    if (field === "event") event = value!;
    if (field === "data") data.push(value!);
  }
  return data.length > 0 ? { event, data: data.join("\n") } : null;
}
