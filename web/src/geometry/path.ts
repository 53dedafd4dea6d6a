/** Polylines of positions (x, y) or poses (x, y, yaw). */

import { type Pose, wrapAngle } from "./points";

export type Path = readonly (readonly number[])[];

/** Length along the path to each of its states. */
export function lengths(path: Path): number[] {
  let total = 0;
  return path.map(([x, y], index) => {
    const former = path[index - 1];
    if (former) total += Math.hypot(x! - former[0]!, y! - former[1]!);
    return total;
  });
}

/** Follows a path at any length along it. */
export class Walker {
  private readonly along: number[];

  constructor(private readonly path: Path) {
    this.along = lengths(path);
  }

  get length(): number {
    return this.along.at(-1) ?? 0;
  }

  /** The pose after `length` metres; a position's yaw is the direction of travel. */
  at(length: number): Pose {
    const last = this.path.length - 1;
    if (last < 1) return pose(this.path[0]!);
    const index = Math.min(this.segment(length), last - 1);
    const [from, to] = [pose(this.path[index]!), pose(this.path[index + 1]!)];
    const step = this.along[index + 1]! - this.along[index]!;
    const share = step > 0 ? Math.min(Math.max((length - this.along[index]!) / step, 0), 1) : 1;
    return {
      x: from.x + share * (to.x - from.x),
      y: from.y + share * (to.y - from.y),
      yaw:
        this.path[0]!.length > 2
          ? wrapAngle(from.yaw + share * wrapAngle(to.yaw - from.yaw))
          : Math.atan2(to.y - from.y, to.x - from.x),
    };
  }

  /** Index of the segment that holds a length, by bisection. */
  private segment(length: number): number {
    let [low, high] = [0, this.along.length - 1];
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (this.along[middle]! <= length) low = middle;
      else high = middle;
    }
    return low;
  }
}

function pose(state: readonly number[]): Pose {
  return { x: state[0]!, y: state[1]!, yaw: state[2] ?? 0 };
}

/** Outline of a car that fits into a disc, pointed at the front; as in the library's pictures. */
const CAR = [
  [0.9, 0],
  [0.62, 0.42],
  [-0.9, 0.42],
  [-0.9, -0.42],
  [0.62, -0.42],
] as const;

/** The outline of a car in a disc of radius `size` at a pose. */
export function carOutline({ x, y, yaw }: Pose, size: number): [number, number][] {
  const [c, s] = [Math.cos(yaw) * size, Math.sin(yaw) * size];
  return CAR.map(([u, v]) => [x + c * u - s * v, y + s * u + c * v]);
}

/** Poses evenly spaced along a path, its ends left out. */
export function along(path: Path, spacing: number, most: number): Pose[] {
  const walker = new Walker(path);
  const count = Math.min(most, Math.floor(walker.length / spacing));
  return Array.from({ length: count }, (_, index) =>
    walker.at((walker.length * (index + 1)) / (count + 1)),
  );
}
