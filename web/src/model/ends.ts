/** A start and a goal to begin with on a map that has none: far apart, free and connected. */

import type { MapInfo } from "../api/types";
import { toWorld } from "../geometry/frame";
import type { Point } from "../geometry/points";
import { FREE, type Raster } from "./raster";

/** Half as far again from obstacles as the robot needs: a comfortable place. */
const COMFORT = 1.5;

export function farApart(raster: Raster, map: MapInfo, radius: number): [Point, Point] | null {
  const cells = Math.max(1, Math.ceil((COMFORT * radius) / map.resolution));
  const open = Uint8Array.from(clearance(raster), (steps) => (steps > cells ? 1 : 0));
  const start = nearest(raster, open, 0, raster.rows - 1);
  if (start === null) return null;
  const reached = connected(raster, open, start);
  const goal = nearest(raster, reached, raster.columns - 1, 0)!;
  return [centre(raster, map, start), centre(raster, map, goal)];
}

function centre({ columns, rows }: Raster, map: MapInfo, cell: number): Point {
  const column = cell % columns;
  const row = rows - 1 - Math.floor(cell / columns);
  return toWorld(map, { x: (column + 0.5) * map.resolution, y: (row + 0.5) * map.resolution });
}

/** Steps (8 neighbours) from each cell to the nearest one that is not free; outside is not. */
function clearance({ columns, rows, cells }: Raster): Int32Array {
  const steps = new Int32Array(cells.length);
  const at = (row: number, column: number) =>
    row < 0 || row >= rows || column < 0 || column >= columns ? 0 : steps[row * columns + column]!;
  const pass = (row: number, column: number, back: 1 | -1) => {
    const index = row * columns + column;
    const near = Math.min(
      at(row - back, column - 1),
      at(row - back, column),
      at(row - back, column + 1),
      at(row, column - back),
    );
    steps[index] = Math.min(steps[index]!, near + 1);
  };
  for (let i = 0; i < cells.length; i++) steps[i] = cells[i] === FREE ? columns + rows : 0;
  for (let row = 0; row < rows; row++) {
    for (let column = 0; column < columns; column++) pass(row, column, 1);
  }
  for (let row = rows - 1; row >= 0; row--) {
    for (let column = columns - 1; column >= 0; column--) pass(row, column, -1);
  }
  return steps;
}

function nearest({ columns }: Raster, wanted: Uint8Array, column: number, row: number) {
  let [best, least] = [null as number | null, Number.POSITIVE_INFINITY];
  for (let i = 0; i < wanted.length; i++) {
    if (wanted[i] === 0) continue;
    const away = Math.hypot((i % columns) - column, Math.floor(i / columns) - row);
    if (away < least) [best, least] = [i, away];
  }
  return best;
}

/** The open cells that can be reached from a cell, 4-connected. */
function connected({ columns, rows }: Raster, open: Uint8Array, from: number): Uint8Array {
  const reached = new Uint8Array(open.length);
  const queue = new Int32Array(open.length);
  let [head, tail] = [0, 0];
  const visit = (cell: number) => {
    if (open[cell] === 1 && reached[cell] === 0) {
      reached[cell] = 1;
      queue[tail++] = cell;
    }
  };
  visit(from);
  while (head < tail) {
    const cell = queue[head++]!;
    const column = cell % columns;
    if (column > 0) visit(cell - 1);
    if (column < columns - 1) visit(cell + 1);
    if (cell >= columns) visit(cell - columns);
    if (cell < columns * (rows - 1)) visit(cell + columns);
  }
  return reached;
}
