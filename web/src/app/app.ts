/** What a visitor can do; the rest of the page shows the outcome. */

import { ApiError, type Client } from "../api/client";
import type {
  GenerateRequest,
  MapInfo,
  MapKind,
  Options,
  PlanResponse,
  RobotKind,
  Stroke,
} from "../api/types";
import { clampToMap, toLocal } from "../geometry/frame";
import type { Point, Pose } from "../geometry/points";
import { farApart } from "../model/ends";
import { exactPose, type Limits, type Problem, type RobotModel, type Run } from "../model/problem";
import type { Raster } from "../model/raster";
import { decode, encode } from "../model/share";
import { type LoadedMap, Maps } from "./maps";
import { Planning } from "./planning";
import { type State, Store } from "./state";

export type End = "start" | "goal";

const DEFAULT_SIZES: Record<RobotKind, Pick<RobotModel, "radius" | "turningRadius">> = {
  point: { radius: 0.1, turningRadius: 0.55 },
  dubins: { radius: 0.2, turningRadius: 0.55 },
  "reeds-shepp": { radius: 0.2, turningRadius: 0.55 },
};

const MOST_RUNS = 4;
/** Each keeps the cells of a map. */
const MOST_UNDOS = 20;

/** The first picture: the README's problem. */
const RESOLUTION = 0.05;
const FIRST_MAP: GenerateRequest = {
  kind: "indoor",
  seed: 6,
  width: 24,
  height: 24,
  resolution: RESOLUTION,
};
const FIRST_ENDS: Record<End, Pose> = {
  start: { x: 19.1, y: 3.4, yaw: 1.57 },
  goal: { x: 2, y: 22.4, yaw: 1.57 },
};

const DAMAGED_LINK = {
  error: "DamagedLink",
  message: "This link is damaged; the first problem is shown instead.",
};

export class App {
  readonly store: Store;
  readonly planning: Planning;
  /** What went wrong with a map or a link, unless a plan was refused since. */
  mapError: ApiError | null = null;
  raster: Raster | null = null;
  private readonly maps: Maps;
  private loaded: LoadedMap | null = null;
  private former: LoadedMap[] = [];
  /** Maps that were asked for: only the last is wanted. */
  private asked = 0;
  /** Maps that were shown so far; drawing on one does not make another. */
  generation = 0;
  /** Strokes that the server does not know yet. */
  strokes: Stroke[] = [];
  private editing: Promise<void> = Promise.resolve();

  constructor(
    readonly client: Client,
    readonly options: Options,
    private readonly changed: () => void,
  ) {
    this.maps = new Maps(client);
    this.planning = new Planning(client, changed, () => {
      this.mapError = null; // the newer error is told
    });
    this.store = new Store({
      problem: null,
      runs: [this.defaultRun("point")],
      limits: { time: Math.min(1, options.limits.plan_seconds), seed: null },
      live: false,
    });
    this.store.subscribe((next, former) => {
      this.changed();
      if (!next.problem) return;
      const { problem, runs, limits, live } = next;
      const same = problem === former.problem && runs === former.runs && limits === former.limits;
      if (same && live === former.live) return;
      if (live) void this.planning.follow({ problem, runs, limits });
      else void this.planning.plan({ problem, runs, limits });
    });
  }

  /** The fragment of a link to what is shown. */
  get link(): string {
    const { problem, runs, limits } = this.store.current;
    if (!problem) return "";
    const { source, map, robot, start, goal } = problem;
    return encode({ source, id: map.id, robot, start, goal, runs, limits });
  }

  /** What a run has found for the problem as it is; null while it has not ended. */
  result(index: number): PlanResponse | null {
    const trace = this.planning.traces[index];
    return trace?.phase === "done" && !this.store.current.live ? trace.response : null;
  }

  /** Shows what a link asks for; the first problem if there is none, or it cannot be had. */
  async begin(fragment: string): Promise<void> {
    const isWanted = this.want();
    const shared = decode(fragment, this.options.limits.plan_seconds);
    this.mapError = shared || fragment === "" ? null : new ApiError(400, DAMAGED_LINK);
    const loaded = shared && (await this.attempt(() => this.maps.shared(shared), isWanted));
    if (shared && loaded) {
      const { robot, limits } = shared;
      const runs = this.runsFor(robot.kind, shared.runs.slice(0, this.mostRuns));
      this.replace(loaded, shared, { limits, runs });
    } else if (isWanted()) {
      await this.beginAnew(isWanted);
    }
  }

  private async beginAnew(isWanted: () => boolean): Promise<void> {
    const keepError = this.mapError !== null; // of the link
    const first = await this.attempt(() => this.maps.generate(FIRST_MAP), isWanted, keepError);
    const robot: RobotModel = { kind: "point", ...DEFAULT_SIZES.point };
    if (first) this.replace(first, { robot, ...FIRST_ENDS });
  }

  /** The maps that the server has; null if it does not say. */
  storedMaps(): Promise<MapInfo[] | null> {
    return this.attempt(
      () => this.client.maps(),
      () => true,
      true,
    );
  }

  generate(kind: MapKind, seed: number, side: number): Promise<void> {
    return this.replaceMap(() =>
      this.maps.generate({ kind, seed, width: side, height: side, resolution: RESOLUTION }),
    );
  }

  upload(files: Iterable<File>, resolution: number | null): Promise<void> {
    return this.replaceMap(() => this.maps.upload(files, resolution));
  }

  open(info: MapInfo): Promise<void> {
    return this.replaceMap(() => this.maps.open(info));
  }

  /** Draws obstacles or erases them; several strokes are sent one after the other. */
  draw(stroke: Stroke): void {
    this.strokes = [...this.strokes, stroke];
    this.changed();
    this.inTurn(async (isShown) => {
      const before = this.loaded!;
      try {
        const after = await this.attempt(() => this.maps.edit(before, stroke), isShown);
        if (!after) return;
        this.former = [...this.former, before].slice(-MOST_UNDOS);
        this.show(after, this.store.current.problem!);
      } finally {
        this.strokes = this.strokes.filter((other) => other !== stroke);
        this.changed();
      }
    });
  }

  get canUndo(): boolean {
    return this.former.length > 0;
  }

  /** Takes back the last stroke, even one that the server is still drawing. */
  undo(): void {
    this.inTurn(async () => {
      const before = this.former.pop();
      if (before) this.show(before, this.store.current.problem!);
    });
  }

  /** Changes the map that is shown, after all changes before; not if another is shown by then. */
  private inTurn(change: (isShown: () => boolean) => Promise<void>): void {
    const { generation } = this;
    const isShown = () => generation === this.generation;
    const before = this.editing.catch(() => {}); // what failed was reported, and stops nothing
    this.editing = before.then(async () => {
      if (isShown()) await change(isShown);
    });
  }

  /** Moves start or goal, to the edge of the map at most. */
  moveEnd(end: End, pose: Pose, live: boolean): void {
    const { problem } = this.store.current;
    if (!problem) return;
    const moved = exactPose({ ...pose, ...clampToMap(problem.map, pose) });
    this.store.update({ problem: { ...problem, [end]: moved }, live });
  }

  swapEnds(): void {
    const { problem } = this.store.current;
    if (!problem) return;
    this.settle({ problem: { ...problem, start: problem.goal, goal: problem.start } });
  }

  rest(): void {
    if (this.store.current.live) this.settle({});
  }

  setRobotKind(kind: RobotKind): void {
    const { problem, runs } = this.store.current;
    if (!problem || problem.robot.kind === kind) return;
    const robot = { kind, ...DEFAULT_SIZES[kind] };
    this.settle({
      problem: { ...problem, robot },
      runs: this.runsFor(kind, runs, problem.robot.kind),
    });
  }

  setRobotSize(size: Partial<Pick<RobotModel, "radius" | "turningRadius">>, live: boolean): void {
    const { problem } = this.store.current;
    if (!problem) return;
    this.store.update({ problem: { ...problem, robot: { ...problem.robot, ...size } }, live });
  }

  setLimits(change: Partial<Limits>): void {
    this.settle({ limits: { ...this.store.current.limits, ...change } });
  }

  setRun(index: number, change: Partial<Run>): void {
    const runs = this.store.current.runs.map((run, i) =>
      i === index ? { ...run, ...change } : run,
    );
    this.settle({ runs });
  }

  private get mostRuns(): number {
    return Math.min(this.options.limits.runs_to_compare, MOST_RUNS);
  }

  get canAddRun(): boolean {
    return this.store.current.runs.length < this.mostRuns;
  }

  /** Adds a run that differs from those there are: unguided first, then other planners. */
  addRun(): void {
    const { runs, problem } = this.store.current;
    if (!problem || !this.canAddRun) return;
    const { planners, default_guide } = this.options.robots[problem.robot.kind];
    const wishes = [
      ...runs.slice(0, 1).flatMap((run) => (run.guide ? [{ ...run, guide: null }] : [])),
      ...["BITstar", "InformedRRTstar", "SST", "RRT", ...planners].flatMap((planner) =>
        planners.includes(planner) ? [{ planner, guide: default_guide, exploration: 0 }] : [],
      ),
    ];
    const isNew = (wish: Run) =>
      !runs.some((run) => run.planner === wish.planner && run.guide === wish.guide);
    this.settle({ runs: [...runs, wishes.find(isNew) ?? wishes[0]!] });
  }

  removeRun(index: number): void {
    const { runs } = this.store.current;
    this.planning.traces.splice(index, 1);
    this.settle({ runs: runs.filter((_, i) => i !== index) });
  }

  planAgain(): void {
    this.settle({ limits: { ...this.store.current.limits } });
  }

  /** Whether a point lies on the map. */
  contains({ x, y }: Point): boolean {
    const { problem } = this.store.current;
    if (!problem) return false;
    const local = toLocal(problem.map, { x, y });
    const { width, height } = problem.map;
    return local.x >= 0 && local.y >= 0 && local.x < width && local.y < height;
  }

  private defaultRun(kind: RobotKind): Run {
    const { default_planner, default_guide } = this.options.robots[kind];
    return { planner: default_planner, guide: default_guide, exploration: 0 };
  }

  /** The runs for a robot: what it does not have, and another robot's default, replaced. */
  private runsFor(kind: RobotKind, runs: readonly Run[], former: RobotKind = kind): Run[] {
    const { planners, guides } = this.options.robots[kind];
    const standard = this.defaultRun(kind);
    const usual = this.defaultRun(former);
    if (runs.length === 0) return [standard];
    return runs.map(({ planner, guide, exploration }) => ({
      planner: planners.includes(planner) ? planner : standard.planner,
      guide:
        guide === null || (guides.includes(guide) && guide !== usual.guide)
          ? guide
          : standard.guide,
      exploration,
    }));
  }

  private async replaceMap(get: () => Promise<LoadedMap>): Promise<void> {
    const loaded = await this.attempt(get, this.want());
    if (!loaded) return;
    const { problem } = this.store.current;
    const robot = problem?.robot ?? { kind: "point", ...DEFAULT_SIZES.point };
    this.replace(loaded, { robot, ...this.ends(loaded, robot) });
  }

  /** Asks for a map; tells whether no other was asked for since. */
  private want(): () => boolean {
    const number = ++this.asked;
    return () => number === this.asked;
  }

  private ends({ info, raster }: LoadedMap, robot: RobotModel): Record<End, Pose> {
    const [start, goal] = farApart(raster, info, robot.radius) ?? [
      { x: info.origin[0], y: info.origin[1] },
      { x: info.origin[0], y: info.origin[1] },
    ];
    const yaw = Math.atan2(goal.y - start.y, goal.x - start.x);
    return { start: exactPose({ ...start, yaw }), goal: exactPose({ ...goal, yaw }) };
  }

  /** Shows another map; what was drawn on the former, or was to be, goes with it. */
  private replace(
    loaded: LoadedMap,
    problem: Pick<Problem, "robot" | "start" | "goal">,
    change: Partial<State> = {},
  ): void {
    this.generation++;
    this.former = [];
    this.strokes = [];
    this.show(loaded, problem, change);
  }

  private show(
    loaded: LoadedMap,
    { robot, start, goal }: Pick<Problem, "robot" | "start" | "goal">,
    change: Partial<State> = {},
  ): void {
    const { info: map, source, raster } = loaded;
    this.loaded = loaded;
    this.raster = raster;
    this.settle({ problem: { map, source, robot, start, goal }, ...change });
  }

  /** Changes something other than by dragging: there is time for a whole plan. */
  private settle(change: Partial<State>): void {
    this.store.update({ ...change, live: false });
  }

  /** What an action brings; null if it is refused, which is told, or not wanted any more. */
  private async attempt<T>(
    action: () => Promise<T>,
    isWanted: () => boolean,
    keepError = false,
  ): Promise<T | null> {
    try {
      const value = await action();
      if (!isWanted()) return null;
      if (!keepError) this.mapError = null;
      return value;
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      if (isWanted()) this.mapError = error;
      this.changed();
      return null;
    }
  }
}
