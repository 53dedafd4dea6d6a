/** From the world (metres, y up) to the screen (CSS pixels, y down) and back. */

import type { Bounds } from "./frame";
import type { Point } from "./points";

export interface Size {
  width: number;
  height: number;
}

export interface View {
  /** The world point in the middle of the screen. */
  centre: Point;
  /** Pixels a metre. */
  scale: number;
}

const MAX_ZOOM = 60;
const MIN_ZOOM = 0.5;

export function fit(bounds: Bounds, size: Size, margin: number): View {
  const width = Math.max(bounds.right - bounds.left, 1e-6);
  const height = Math.max(bounds.top - bounds.bottom, 1e-6);
  const scale = Math.min((size.width - 2 * margin) / width, (size.height - 2 * margin) / height);
  return {
    centre: { x: (bounds.left + bounds.right) / 2, y: (bounds.bottom + bounds.top) / 2 },
    scale: Math.max(scale, 1e-3),
  };
}

export function toScreen(view: View, size: Size, world: Point): Point {
  return {
    x: size.width / 2 + (world.x - view.centre.x) * view.scale,
    y: size.height / 2 - (world.y - view.centre.y) * view.scale,
  };
}

export function toWorld(view: View, size: Size, screen: Point): Point {
  return {
    x: view.centre.x + (screen.x - size.width / 2) / view.scale,
    y: view.centre.y - (screen.y - size.height / 2) / view.scale,
  };
}

/** Moves what is shown by (dx, dy) pixels. */
export function panned(view: View, dx: number, dy: number): View {
  const { centre, scale } = view;
  return { centre: { x: centre.x - dx / scale, y: centre.y + dy / scale }, scale };
}

/** Zooms by a factor; what is under the screen point `at` stays there. */
export function zoomed(view: View, size: Size, at: Point, factor: number, fitted: View): View {
  const scale = Math.min(
    Math.max(view.scale * factor, fitted.scale * MIN_ZOOM),
    fitted.scale * MAX_ZOOM,
  );
  const fixed = toWorld(view, size, at);
  return {
    scale,
    centre: {
      x: fixed.x - (at.x - size.width / 2) / scale,
      y: fixed.y + (at.y - size.height / 2) / scale,
    },
  };
}

export type Matrix = [a: number, b: number, c: number, d: number, e: number, f: number];

/** For `setTransform`: from the world to the pixels of a canvas with `ratio` pixels a CSS pixel. */
export function worldMatrix(view: View, size: Size, ratio: number): Matrix {
  const scale = view.scale * ratio;
  const origin = toScreen(view, size, { x: 0, y: 0 });
  return [scale, 0, 0, -scale, origin.x * ratio, origin.y * ratio];
}

/** From the screen as `from` shows it to the screen as `to` does: x' = scale x + dx. */
export function between(
  from: View,
  to: View,
  size: Size,
): { scale: number; dx: number; dy: number } {
  const scale = to.scale / from.scale;
  const corner = toScreen(to, size, toWorld(from, size, { x: 0, y: 0 }));
  return { scale, dx: corner.x, dy: corner.y };
}
