/** A map's own frame: its origin is the lower-left corner of the map. */

import type { MapInfo } from "../api/types";
import type { Point } from "./points";

type Placed = Pick<MapInfo, "origin" | "width" | "height">;

export function toWorld(map: Placed, local: Point): Point {
  const [x, y, yaw] = map.origin;
  const [c, s] = [Math.cos(yaw), Math.sin(yaw)];
  return { x: x + c * local.x - s * local.y, y: y + s * local.x + c * local.y };
}

export function toLocal(map: Placed, world: Point): Point {
  const [x, y, yaw] = map.origin;
  const [c, s] = [Math.cos(yaw), Math.sin(yaw)];
  const [dx, dy] = [world.x - x, world.y - y];
  return { x: c * dx + s * dy, y: -s * dx + c * dy };
}

/** The nearest point on the map, a little inside its edge. */
export function clampToMap(map: Placed, world: Point): Point {
  const { x, y } = toLocal(map, world);
  const clamp = (value: number, size: number) =>
    Math.min(Math.max(value, 0.001), Math.max(size - 0.001, 0.001));
  return toWorld(map, { x: clamp(x, map.width), y: clamp(y, map.height) });
}

export interface Bounds {
  left: number;
  right: number;
  bottom: number;
  top: number;
}

/** The smallest upright rectangle round the map in the world frame. */
export function mapBounds(map: Placed): Bounds {
  const corners = [
    [0, 0],
    [map.width, 0],
    [0, map.height],
    [map.width, map.height],
  ].map(([x, y]) => toWorld(map, { x: x!, y: y! }));
  const xs = corners.map((corner) => corner.x);
  const ys = corners.map((corner) => corner.y);
  return {
    left: Math.min(...xs),
    right: Math.max(...xs),
    bottom: Math.min(...ys),
    top: Math.max(...ys),
  };
}
