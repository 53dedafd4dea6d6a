/** The panels with the view that they share: what is drawn, where, and when. */

import type { Stroke } from "../api/types";
import type { App } from "../app/app";
import { type Palette, palette, type Theme } from "../draw/palette";
import { obstacles, type Placed } from "../draw/rasters";
import type { Layers } from "../draw/scene";
import { mapBounds } from "../geometry/frame";
import { Walker } from "../geometry/path";
import type { Point, Pose } from "../geometry/points";
import { fit, panned, type Size, toWorld, type View, zoomed } from "../geometry/view";
import { byId } from "./dom";
import { listenToGestures } from "./gestures";
import { Panel } from "./panel";

export type Tool = "move" | "start" | "goal" | "wall" | "erase";

const MARGIN = 10;
/** Milliseconds after which a moved view counts as at rest. */
const REST = 140;
/** Seconds that the robot takes along the longest path. */
const DRIVE_SECONDS = 6;
const ZOOM_STEP = 1.4;

export class Stage {
  readonly layers: Layers = {
    heat: true,
    region: false,
    tree: true,
    path: true,
    band: true,
    best: false,
  };
  tool: Tool = "move";
  brush = 0.25;
  onToolUsed: (tool: Tool) => void = () => {};
  onDrive: (drives: boolean) => void = () => {};
  panels: Panel[] = [];
  private readonly parent = byId("panels");
  private size: Size = { width: 1, height: 1 };
  private view: View = { centre: { x: 0, y: 0 }, scale: 1 };
  private fitted: View = this.view;
  private fittedTo = "";
  private frame = 0;
  private moves = false;
  private resting = 0;
  private stroke: Stroke | null = null;
  /** The generation of the map under the stroke. */
  private strokeOn = 0;
  private driveBegan: number | null = null;
  private walls: { key: string; image: Placed } | null = null;

  constructor(
    private readonly app: App,
    private readonly theme: () => Theme,
  ) {
    new ResizeObserver(() => this.resize()).observe(this.parent);
    window.addEventListener("resize", () => this.resize());
  }

  get colours(): Palette {
    return palette(this.theme());
  }

  get lens() {
    return { view: this.view, size: this.size };
  }

  /** Brings panels, figures and pictures up to date with the next frame. */
  invalidate(): void {
    this.frame ||= requestAnimationFrame((now) => {
      this.frame = 0;
      this.render(now);
    });
  }

  zoom(steps: number): void {
    const { width, height } = this.size;
    const centre = { x: width / 2, y: height / 2 };
    this.setView(zoomed(this.view, this.size, centre, ZOOM_STEP ** steps, this.fitted));
  }

  fit(): void {
    this.setView(this.fitted);
  }

  get canDrive(): boolean {
    return this.app.planning.traces.some((trace) => trace.path.length > 1);
  }

  /** Drives along the paths, or stops. */
  drive(): void {
    this.driveBegan = this.driveBegan === null && this.canDrive ? performance.now() : null;
    this.onDrive(this.driveBegan !== null);
    this.invalidate();
  }

  setTool(tool: Tool): void {
    this.tool = tool;
    for (const panel of this.panels) panel.view.dataset.tool = tool;
  }

  private render(now: number): void {
    const { problem, runs } = this.app.store.current;
    if (!problem) return;
    this.matchPanels(runs.length);
    this.fitMap();
    const { traces, bestPath } = this.app.planning;
    const { colours } = this;
    const drivers = this.drivers(now);
    this.panels.forEach((panel, index) => {
      const trace = traces[index];
      panel.update(runs[index]!, trace, colours);
      if (!trace) return;
      panel.draw(
        {
          view: this.view,
          size: this.size,
          ratio: window.devicePixelRatio,
          moves: this.moves,
          colours,
          layers: this.layers,
          map: problem.map,
          obstacles: this.wallImage(colours),
          robot: problem.robot,
          start: problem.start,
          goal: problem.goal,
          best: bestPath,
          strokes: this.stroke ? [...this.app.strokes, this.stroke] : this.app.strokes,
        },
        trace,
        drivers[index] ?? null,
      );
    });
    const lags = this.layers.tree && traces.some(({ tree }) => tree.lags);
    if (this.driveBegan !== null || lags) this.invalidate();
  }

  private matchPanels(count: number): void {
    if (this.panels.length === count) return;
    this.panels = Array.from({ length: count }, (_, index) => {
      const panel = this.panels[index] ?? this.newPanel(index);
      return panel;
    });
    this.parent.replaceChildren(...this.panels.map((panel) => panel.element));
    this.parent.style.setProperty("--columns", String(Math.min(count, 2)));
    this.setTool(this.tool);
    this.resize();
  }

  private newPanel(index: number): Panel {
    const panel = new Panel(
      this.app,
      index,
      () => this.lens,
      () => this.invalidate(),
    );
    listenToGestures(panel.canvas, {
      dragStart: (at) => this.beginStroke(at),
      dragMove: (at, from) => this.dragTo(at, from),
      dragEnd: (_, cancelled) => this.endStroke(cancelled),
      click: (at) => this.click(at),
      pinch: (from, to, factor) => {
        const moved = panned(this.view, to.x - from.x, to.y - from.y);
        this.setView(zoomed(moved, this.size, to, factor, this.fitted));
      },
    });
    return panel;
  }

  private world(at: Point): Point {
    return toWorld(this.view, this.size, at);
  }

  private beginStroke(at: Point): void {
    if (this.tool !== "wall" && this.tool !== "erase") return;
    const { x, y } = this.world(at);
    this.stroke = { points: [[x, y]], radius: this.brush, occupied: this.tool === "wall" };
    this.strokeOn = this.app.generation;
    this.invalidate();
  }

  private dragTo(at: Point, from: Point): void {
    if (!this.stroke) {
      this.setView(panned(this.view, at.x - from.x, at.y - from.y));
      return;
    }
    const { x, y } = this.world(at);
    const [lastX, lastY] = this.stroke.points.at(-1)!;
    if (Math.hypot(x - lastX, y - lastY) > this.stroke.radius / 2) this.stroke.points.push([x, y]);
    this.invalidate();
  }

  private endStroke(cancelled: boolean): void {
    const { stroke } = this;
    this.stroke = null;
    if (stroke && !cancelled && this.strokeOn === this.app.generation) this.app.draw(stroke);
    this.invalidate();
  }

  private click(at: Point): void {
    const { tool } = this;
    const { problem } = this.app.store.current;
    if (!problem || (tool !== "start" && tool !== "goal")) return;
    const world = this.world(at);
    if (!this.app.contains(world)) return;
    this.app.moveEnd(tool, { ...problem[tool], ...world }, false);
    this.onToolUsed(tool);
  }

  private setView(view: View): void {
    this.view = view;
    this.moves = true;
    clearTimeout(this.resting);
    this.resting = window.setTimeout(() => {
      this.moves = false;
      this.invalidate();
    }, REST);
    this.invalidate();
  }

  private resize(): void {
    const first = this.panels[0];
    if (!first) return;
    const { problem } = this.app.store.current;
    const width = first.view.clientWidth;
    const most = Math.max(260, window.innerHeight - 290) / (this.panels.length > 2 ? 1.35 : 1);
    const bounds = problem && mapBounds(problem.map);
    const aspect = bounds ? (bounds.top - bounds.bottom) / (bounds.right - bounds.left) : 1;
    const height = Math.round(Math.min(width * Math.min(Math.max(aspect, 0.4), 1.4), most));
    this.parent.style.setProperty("--view-height", `${height}px`);
    this.size = { width, height };
    this.invalidate();
  }

  /** Shows the whole map when it is a new one, and keeps the view where only cells changed. */
  private fitMap(): void {
    const { problem } = this.app.store.current;
    if (!problem) return;
    const { width, height, origin } = problem.map;
    const extent = `${width} ${height} ${origin}`;
    const key = `${extent} ${this.size.width} ${this.size.height}`;
    if (key === this.fittedTo) return;
    if (!this.fittedTo.startsWith(extent)) this.resize();
    this.fittedTo = `${extent} ${this.size.width} ${this.size.height}`;
    this.fitted = fit(mapBounds(problem.map), this.size, MARGIN);
    this.view = this.fitted;
  }

  private wallImage(colours: Palette): Placed {
    const { map } = this.app.store.current.problem!;
    const key = `${map.id} ${colours.obstacle}`;
    if (this.walls?.key !== key) {
      this.walls = { key, image: obstacles(map, this.app.raster!, colours) };
    }
    return this.walls.image;
  }

  /** Where the robots are: all drive at the same speed. */
  private drivers(now: number): (Pose | null)[] {
    if (this.driveBegan === null) return [];
    const walkers = this.app.planning.traces.map((trace) =>
      trace.path.length > 1 ? new Walker(trace.path) : null,
    );
    const longest = Math.max(0, ...walkers.map((walker) => walker?.length ?? 0));
    const share = Math.max(0, now - this.driveBegan) / (1000 * DRIVE_SECONDS);
    if (share >= 1 || longest === 0) {
      this.driveBegan = null;
      this.onDrive(false);
      return [];
    }
    return walkers.map((walker) => walker?.at(Math.min(share * longest, walker.length)) ?? null);
  }
}
