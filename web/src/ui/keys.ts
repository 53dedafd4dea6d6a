/** The keyboard; the help panel in index.html lists what it does. */

import type { App } from "../app/app";
import { byId } from "./dom";
import type { Exports } from "./exports";
import type { Stage, Tool } from "./stage";
import type { Toolbar } from "./toolbar";

const TOOLS: Record<string, Tool> = { v: "move", s: "start", g: "goal", w: "wall", e: "erase" };

interface Parts {
  app: App;
  stage: Stage;
  toolbar: Toolbar;
  exports: Exports;
}

export function listenToKeys({ app, stage, toolbar, exports }: Parts): void {
  const help = byId<HTMLDialogElement>("help-dialog");
  byId("help").addEventListener("click", () => help.showModal());
  const actions: Record<string, () => void> = {
    x: () => app.swapEnds(),
    c: () => app.addRun(),
    l: () => void exports.copyLink(),
    "?": () => help.showModal(),
    "+": () => stage.zoom(1),
    "=": () => stage.zoom(1),
    "-": () => stage.zoom(-1),
    "0": () => stage.fit(),
    " ": () => stage.drive(),
    Enter: () => app.planAgain(),
    Escape: () => toolbar.choose("move"),
  };
  document.addEventListener("keydown", (event) => {
    if (document.querySelector("dialog[open]") || event.altKey || isTyping(event)) return;
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    if (event.ctrlKey || event.metaKey) {
      if (key !== "z" || event.shiftKey) return; // with Shift it redoes, elsewhere
      app.undo();
    } else if (TOOLS[key]) {
      toolbar.choose(TOOLS[key]);
    } else if (actions[key]) {
      actions[key]();
    } else {
      return;
    }
    event.preventDefault();
  });
}

/** Whether the key belongs to the element that has the focus. */
function isTyping(event: KeyboardEvent): boolean {
  const target = event.target as HTMLElement;
  if (target.matches("input[type=number], select, textarea")) return true;
  const activates = event.key === " " || event.key === "Enter";
  return activates && target.matches("button:not(.handle), summary, a, input");
}
