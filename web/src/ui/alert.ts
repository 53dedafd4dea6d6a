/** Errors in words, near the map, with a way out where there is one. */

import type { ApiError } from "../api/client";
import type { App, End } from "../app/app";
import { byId, setText } from "./dom";

const BLOCKED: Record<string, End> = { StartOccupied: "start", GoalOccupied: "goal" };

export class Alert {
  private readonly box = byId("alert");
  private readonly fix = byId("alert-fix");
  /** The error with a plan that the visitor has read. */
  private closed: ApiError | null = null;

  constructor(private readonly app: App) {
    this.fix.addEventListener("click", () => this.moveToFree());
    byId("alert-close").addEventListener("click", () => {
      if (app.mapError) app.mapError = null;
      else this.closed = app.planning.error;
      this.update();
    });
  }

  update(): void {
    const { error } = this;
    this.box.hidden = error === null || error === this.closed;
    if (error === null) return;
    setText(byId("alert-text"), sentence(error.message));
    const end = error.nearestFree && BLOCKED[error.kind];
    this.fix.hidden = !end;
    if (end) setText(this.fix, `Move the ${end} to the nearest free point`);
  }

  private get error(): ApiError | null {
    return this.app.mapError ?? this.app.planning.error;
  }

  private moveToFree(): void {
    const { error } = this;
    const end = error && BLOCKED[error.kind];
    const { problem } = this.app.store.current;
    if (!end || !error.nearestFree || !problem) return;
    const [x, y] = error.nearestFree;
    this.app.moveEnd(end, { ...problem[end], x, y }, false);
  }
}

function sentence(text: string): string {
  // A word, not the name of a file.
  const begun = text
    .trim()
    .replace(/^[a-z]+(?= )/, (word) => word.charAt(0).toUpperCase() + word.slice(1));
  return /[.!?]$/.test(begun) ? begun : `${begun}.`;
}
