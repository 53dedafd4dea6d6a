/** The server's JSON. Lengths in metres, angles in rad, times in seconds, world frame. */

export type RobotKind = "point" | "dubins" | "reeds-shepp";

export interface Robot {
  kind: RobotKind;
  radius: number;
  turning_radius?: number;
}

export type MapKind = "forest" | "maze" | "indoor";

export interface GenerateRequest {
  kind: MapKind;
  seed: number;
  width: number;
  height: number;
  resolution: number;
}

export interface MapInfo {
  /** Digest of the cells, the resolution and the origin. */
  id: string;
  name: string;
  rows: number;
  columns: number;
  resolution: number;
  /** World pose (x, y, yaw) of the lower-left corner. */
  origin: [number, number, number];
  width: number;
  height: number;
  /** Share of the cells, 0 to 1. */
  occupied: number;
  /** The request that generates this map; null for others. */
  source: GenerateRequest | null;
}

export interface Stroke {
  points: [number, number][];
  radius: number;
  occupied: boolean;
}

export interface RobotOptions {
  planners: string[];
  guides: string[];
  default_planner: string;
  default_guide: string;
  /** Planners that do without a guide: they have learned to plan. */
  unguided_planners: string[];
}

export interface Options {
  version: string;
  robots: Record<RobotKind, RobotOptions>;
  limits: { plan_seconds: number; runs_to_compare: number };
}

export interface PlanRequest {
  map: string;
  robot: Robot;
  /** (x, y), for a car (x, y, yaw). */
  start: number[];
  goal: number[];
  planner: string;
  /** Null plans unguided. */
  guide: string | null;
  exploration: number;
  time_limit: number;
  seed?: number;
  tree: boolean;
  region: boolean;
}

export interface RegionResponse {
  guide: string;
  rows: number;
  columns: number;
  /** Row-major, row 0 = lowest y. */
  probability: number[];
  anchors: [number, number][];
  anchor_size: number;
  /** Base64 PNG with the layout of the map's image: 255 inside the region, 0 outside. */
  mask: string;
  threshold: number;
  proposal_seconds: number;
}

export interface TreeResponse {
  /** Index of the first vertex of this increment, which replaces all from there on; 0 if absent. */
  first?: number;
  /** x0, y0, x1, y1, ... of the new vertices. */
  vertices: number[];
  /** Index of each new vertex's parent in the whole tree, -1 for a root. */
  parents: number[];
  /** Older vertices with a new parent: index, parent, ... */
  changed?: number[];
  /** Further edges of a roadmap, i0, j0, ...; replaces the former ones. */
  links?: number[];
  /** For a car: x0, y0, ... between the ends of the edges of new vertices, changed ones and links. */
  curves?: number[][];
}

export interface PlanResponse {
  solved: boolean;
  status: string;
  path: number[][];
  length: number | null;
  vertices: number;
  planning_seconds: number;
  proposal_seconds: number;
  total_seconds: number;
  planner: string;
  guide: string | null;
  seed: number;
  region: RegionResponse | null;
  tree: TreeResponse | null;
}

export interface Progress {
  seconds: number;
  length: number | null;
  vertices: number;
  /** Null where it has not changed. */
  path: number[][] | null;
  tree: TreeResponse | null;
}

export type PlanEvent =
  | { event: "region"; data: RegionResponse }
  | { event: "progress"; data: Progress }
  | { event: "result"; data: PlanResponse };

export interface ErrorBody {
  error: string;
  message: string;
  details?: { nearest_free?: [number, number] };
}
