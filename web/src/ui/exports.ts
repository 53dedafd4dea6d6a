/** What can be taken away: link, path, picture and program. */

import type { App } from "../app/app";
import type { Trace } from "../app/trace";
import { pathCsv, pathJson } from "../model/files";
import { type Run, runName } from "../model/problem";
import { snippet } from "../model/snippet";
import { byId, copy, save, toast } from "./dom";
import type { Stage } from "./stage";
import { count, metres } from "./words";

const HEADLINE = 34;
const GAP = 16;

export class Exports {
  private readonly menu = byId<HTMLDetailsElement>("export");
  private readonly dialog = byId<HTMLDialogElement>("code-dialog");

  constructor(
    private readonly app: App,
    private readonly stage: Stage,
  ) {
    byId("share").addEventListener("click", () => void this.copyLink());
    this.onItem("export-csv", () => this.savePaths("csv", "text/csv"));
    this.onItem("export-json", () => this.savePaths("json", "application/json"));
    this.onItem("export-picture", () => this.savePicture());
    this.onItem("export-python", () => this.showProgram());
    byId("code-copy").addEventListener("click", () => void copy(this.program, "Program copied"));
    byId("code-save").addEventListener("click", () =>
      save("plan.py", new Blob([this.program], { type: "text/x-python" })),
    );
    document.addEventListener("click", (event) => {
      if (!this.menu.contains(event.target as Node)) this.menu.open = false;
    });
  }

  copyLink(): Promise<void> {
    return copy(new URL(this.app.link, location.href).href, "Link copied");
  }

  private onItem(id: string, action: () => void): void {
    byId(id).addEventListener("click", () => {
      this.menu.open = false;
      action();
    });
  }

  /** Of the first run: the others' programs differ by a name. */
  private get program(): string {
    return byId("code").textContent ?? "";
  }

  private showProgram(): void {
    const { problem, runs, limits } = this.app.store.current;
    if (!problem) return;
    // The seed that was drawn belongs to the plan that is shown.
    const seed = limits.seed ?? this.app.result(0)?.seed ?? null;
    byId("code").textContent = snippet({
      problem,
      run: runs[0]!,
      limits: { ...limits, seed },
      imageUrl: this.app.client.imageUrl(problem.map.id),
    });
    this.dialog.showModal();
  }

  private savePaths(suffix: "csv" | "json", type: string): void {
    const { problem, runs, limits } = this.app.store.current;
    const found = runs.flatMap((run, index) => {
      const response = this.app.result(index);
      return response?.solved ? [{ run, index, response }] : [];
    });
    if (!problem || found.length === 0) {
      toast("There is no path yet.");
      return;
    }
    for (const { run, index, response } of found) {
      const text = suffix === "csv" ? pathCsv(response) : pathJson(problem, run, limits, response);
      const number = runs.length > 1 ? `-${index + 1}-${run.planner}` : "";
      save(`path${number}.${suffix}`, new Blob([text], { type }));
    }
  }

  /** All panels as they are, each under a line that says what it shows. */
  private savePicture(): void {
    const { runs } = this.app.store.current;
    const { panels, colours } = this.stage;
    const [first] = panels;
    if (!first) return;
    const ratio = window.devicePixelRatio;
    const columns = Math.min(panels.length, 2);
    const width = first.canvas.width + GAP * ratio;
    const height = first.canvas.height + (HEADLINE + GAP) * ratio;
    const canvas = new OffscreenCanvas(
      columns * width + GAP * ratio,
      Math.ceil(panels.length / columns) * height + GAP * ratio,
    );
    const context = canvas.getContext("2d")!;
    const style = getComputedStyle(document.documentElement);
    context.fillStyle = style.backgroundColor;
    context.fillRect(0, 0, canvas.width, canvas.height);
    context.font = `${15 * ratio}px ${style.fontFamily}`;
    panels.forEach((panel, index) => {
      const x = GAP * ratio + (index % columns) * width;
      const y = GAP * ratio + Math.floor(index / columns) * height;
      context.fillStyle = colours.runs[index]!;
      context.fillText(headline(runs[index]!, this.app.planning.traces[index]), x, y + 18 * ratio);
      context.drawImage(panel.canvas, x, y + HEADLINE * ratio);
    });
    void canvas.convertToBlob({ type: "image/png" }).then((blob) => save("plan.png", blob));
  }
}

function headline(run: Run, trace: Trace | undefined): string {
  const length = trace?.length == null ? "no path" : metres(trace.length);
  return `${runName(run)}: ${length}, ${count(trace?.vertices ?? 0)} vertices`;
}
