/** One run: the choice of its planner, its picture and its figures. */

import type { RegionResponse } from "../api/types";
import type { App } from "../app/app";
import type { Trace } from "../app/trace";
import type { Palette } from "../draw/palette";
import { decodeMask, heatMap, type Placed, type RegionMask, regionImage } from "../draw/rasters";
import { drawScene, type Scene } from "../draw/scene";
import { type Run, runName } from "../model/problem";
import { make, setChoices, setText } from "./dom";
import { Handles, type Lens } from "./handles";
import { count, metres, seconds } from "./words";

const UNGUIDED = "none";
const EXPLORATION = [
  ["0", "region only"],
  ["0.1", "10 % outside"],
  ["0.5", "half outside"],
] as const;

/** What a scene shows of the stage: the same in all panels. */
export type SharedScene = Omit<
  Scene,
  "heat" | "region" | "tree" | "path" | "pathColour" | "driver"
>;

export class Panel {
  readonly element = make("article", { class: "panel" });
  readonly view = make("div", { class: "view" });
  readonly canvas = make("canvas");
  private readonly context = this.canvas.getContext("2d")!;
  private readonly handles: Handles;
  private readonly planner = make("select", { "aria-label": "Planner" });
  private readonly guide = make("select", { "aria-label": "Guide" });
  private readonly exploration = make("select", { "aria-label": "Samples outside the region" });
  private readonly remove = make(
    "button",
    {
      type: "button",
      class: "icon remove",
      "aria-label": "Remove this planner",
    },
    "×",
  );
  private readonly figures: Record<
    "length" | "vertices" | "time" | "proposal" | "status",
    HTMLElement
  >;
  private readonly heat = memo(heatMap);
  private readonly region = memo(regionImage);

  private decoding: RegionResponse | null = null;
  private decoded: RegionMask | null = null;

  constructor(
    private readonly app: App,
    private readonly index: number,
    lens: () => Lens,
    private readonly changed: () => void,
  ) {
    const figure = (name: string) => make("dd", { "data-figure": name });
    this.figures = {
      length: figure("length"),
      vertices: figure("vertices"),
      time: figure("time"),
      proposal: figure("proposal"),
      status: figure("status"),
    };
    this.view.append(this.canvas);
    this.handles = new Handles(app, this.view, lens);
    this.element.append(
      make(
        "header",
        {},
        make("span", { class: "swatch", "aria-hidden": "true" }),
        this.planner,
        this.guide,
        this.exploration,
        this.remove,
      ),
      this.view,
      this.stats(),
    );
    this.listen();
  }

  /** Brings choices and figures up to date. */
  update(run: Run, trace: Trace | undefined, colours: Palette): void {
    const { problem, runs } = this.app.store.current;
    const robot = this.app.options.robots[problem?.robot.kind ?? "point"];
    const guided = !robot.unguided_planners.includes(run.planner);
    this.element.style.setProperty("--run", colours.runs[this.index]!);
    this.element.setAttribute("aria-label", runName(run));
    setChoices(
      this.planner,
      robot.planners.map((name) => [name, name]),
      run.planner,
    );
    const guides = [
      ...robot.guides.map((name) => [name, `guide ${name}`] as const),
      [UNGUIDED, "unguided"] as const,
    ];
    setChoices(this.guide, guides, run.guide ?? UNGUIDED);
    setChoices(this.exploration, explorations(run.exploration), String(run.exploration));
    this.guide.hidden = !guided;
    this.exploration.hidden = !guided || run.guide === null;
    this.remove.hidden = runs.length === 1;
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", describe(run, trace));
    this.showFigures(trace);
  }

  draw(shared: SharedScene, trace: Trace, driver: Scene["driver"]): void {
    const { size, ratio, map, colours, layers } = shared;
    const mask = layers.region && trace.region ? this.mask(trace.region) : null;
    const [width, height] = [Math.round(size.width * ratio), Math.round(size.height * ratio)];
    if (this.canvas.width !== width || this.canvas.height !== height) {
      this.canvas.width = width;
      this.canvas.height = height;
    }
    drawScene(this.context, {
      ...shared,
      heat: trace.region && this.heat(map, trace.region, colours),
      region: mask && this.region(map, mask, colours),
      tree: trace.tree,
      path: trace.path,
      pathColour: colours.runs[this.index]!,
      driver,
    });
    this.handles.place();
  }

  /** The region's mask; the last one until that of a new region is decoded. */
  private mask(region: RegionResponse): RegionMask | null {
    if (region !== this.decoding) {
      this.decoding = region;
      void decodeMask(region.mask).then((mask) => {
        if (region !== this.decoding) return; // a newer one has overtaken it
        this.decoded = mask;
        this.changed();
      });
    }
    return this.decoded;
  }

  private stats(): HTMLElement {
    const { length, vertices, time, proposal, status } = this.figures;
    const figure = (name: string, value: HTMLElement) =>
      make("div", {}, make("dt", {}, name), value);
    const outcome = figure("Path", status);
    outcome.className = "status";
    return make(
      "dl",
      { class: "stats" },
      figure("Length", length),
      figure("Vertices", vertices),
      figure("Search", time),
      figure("Proposal", proposal),
      outcome,
    );
  }

  private listen(): void {
    const { app, index } = this;
    this.planner.addEventListener("change", () =>
      app.setRun(index, { planner: this.planner.value }),
    );
    this.guide.addEventListener("change", () =>
      app.setRun(index, { guide: this.guide.value === UNGUIDED ? null : this.guide.value }),
    );
    this.exploration.addEventListener("change", () =>
      app.setRun(index, { exploration: Number(this.exploration.value) }),
    );
    this.remove.addEventListener("click", () => app.removeRun(index));
  }

  private showFigures(trace: Trace | undefined): void {
    const known = trace && trace.vertices > 0;
    const { length, vertices, time, proposal, status } = this.figures;
    setText(length, known && trace.length !== null ? metres(trace.length) : "–");
    setText(vertices, known ? count(trace.vertices) : "–");
    setText(time, known ? seconds(trace.seconds) : "–");
    setText(proposal, known ? proposalTime(trace) : "–");
    setText(status, trace ? statusText(trace) : "");
    status.parentElement!.classList.toggle("failed", trace?.response?.solved === false);
  }
}

function proposalTime({ region, response }: Trace): string {
  const taken = response?.proposal_seconds ?? region?.proposal_seconds ?? 0;
  return taken > 0 ? seconds(taken) : "none";
}

function statusText({ phase, response }: Trace): string {
  if (phase === "planning") return "searching…";
  if (phase === "waiting") return "waiting";
  if (phase === "failed" || !response) return "no plan";
  return `${response.solved ? "found" : "none"} (${response.status})`;
}

function describe(run: Run, trace: Trace | undefined): string {
  const found = trace?.length == null ? "no path yet" : `a path of ${metres(trace.length)}`;
  return `Map with ${found} by ${runName(run)}`;
}

/** The usual shares, and that of a link if it is another. */
function explorations(chosen: number): (readonly [string, string])[] {
  if (EXPLORATION.some(([value]) => Number(value) === chosen)) return [...EXPLORATION];
  return [...EXPLORATION, [String(chosen), `${(100 * chosen).toFixed(0)} % outside`]];
}

/** Remembers the last image for as long as it is made of the same objects. */
function memo<A extends unknown[]>(create: (...from: A) => Placed): (...from: A) => Placed {
  let last: { from: A; image: Placed } | null = null;
  return (...from) => {
    if (!last || from.some((value, index) => value !== last!.from[index])) {
      last = { from, image: create(...from) };
    }
    return last.image;
  };
}
