/** Points and poses in the world frame: metres, x right, y up, yaw counter-clockwise in rad. */

export interface Point {
  x: number;
  y: number;
}

export interface Pose extends Point {
  yaw: number;
}

export function distance(a: Point, b: Point): number {
  return Math.hypot(b.x - a.x, b.y - a.y);
}

/** The angle in [-pi, pi). */
export function wrapAngle(angle: number): number {
  const turn = 2 * Math.PI;
  return angle - turn * Math.floor((angle + Math.PI) / turn);
}

/** A number in as few digits as `digits` decimals need. */
export function rounded(value: number, digits: number): number {
  const scale = 10 ** digits;
  return Math.round(value * scale) / scale + 0; // + 0: never -0
}
