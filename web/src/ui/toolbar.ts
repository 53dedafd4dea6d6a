/** The tools above the map. */

import type { App } from "../app/app";
import { byId, setText } from "./dom";
import type { Stage, Tool } from "./stage";
import { metres } from "./words";

const HINTS: Partial<Record<Tool, string>> = {
  start: "Click or tap where the robot starts.",
  goal: "Click or tap where it should go.",
};

export class Toolbar {
  private readonly brush = byId<HTMLInputElement>("brush");
  private readonly driveButton = byId("drive") as HTMLButtonElement;

  constructor(
    private readonly app: App,
    private readonly stage: Stage,
  ) {
    for (const radio of radios()) {
      radio.addEventListener("change", () => this.choose(radio.value as Tool));
    }
    this.brush.addEventListener("input", () => this.setBrush());
    byId("undo").addEventListener("click", () => app.undo());
    byId("zoom-in").addEventListener("click", () => stage.zoom(1));
    byId("zoom-out").addEventListener("click", () => stage.zoom(-1));
    byId("zoom-fit").addEventListener("click", () => stage.fit());
    this.driveButton.addEventListener("click", () => stage.drive());
    stage.onDrive = (drives) => setText(this.driveButton, drives ? "■ Stop" : "▶ Drive");
    // After the start comes the goal, and then there is nothing more to place.
    stage.onToolUsed = (tool) => this.choose(tool === "start" ? "goal" : "move");
    this.setBrush();
  }

  choose(tool: Tool): void {
    for (const radio of radios()) radio.checked = radio.value === tool;
    this.stage.setTool(tool);
    byId("brush-field").hidden = tool !== "wall" && tool !== "erase";
    const hint = HINTS[tool];
    byId("hint").hidden = hint === undefined;
    setText(byId("hint"), hint ?? "");
  }

  update(): void {
    (byId("undo") as HTMLButtonElement).disabled = !this.app.canUndo;
    this.driveButton.disabled = !this.stage.canDrive;
    byId("add-run").hidden = !this.app.canAddRun;
  }

  private setBrush(): void {
    this.stage.brush = Number(this.brush.value);
    setText(byId("brush-value"), metres(2 * this.stage.brush));
  }
}

function radios(): NodeListOf<HTMLInputElement> {
  return document.querySelectorAll<HTMLInputElement>("[name=tool]");
}
