"""Maze maps: perfect mazes by randomised depth-first search, as in the MPT paper's experiments."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from planformer.errors import InvalidParameter
from planformer.maps._generation import (
    Seed,
    cell_centres,
    grid_shape,
    random_generator,
    require_extent,
)
from planformer.maps.grid import OccupancyGrid

WALL = 0.375
PASSAGE = 1.2
_PITCH = WALL + PASSAGE


def generate_maze(
    seed: Seed,
    *,
    width: float = 24.0,
    height: float = 24.0,
    resolution: float = 0.05,
) -> OccupancyGrid:
    """Generate a perfect maze: exactly one way between any two of its cells.

    Walls are 0.375 m and passages 1.2 m wide, so 24 m hold 15 x 15 maze cells; randomised
    depth-first search. Johnson et al., Motion Planning Transformers, section IV.A. Where the
    size is no whole number of maze cells, the maze is centred and the rest is occupied.

    Args:
        seed: Integer >= 0 or NumPy Generator; the same seed gives the same map.
        width: Extent along x in metres, at least 1.95 m.
        height: Extent along y in metres, at least 1.95 m.
        resolution: Side of a cell in metres, at most 0.375 m so that no wall vanishes.

    Returns:
        The map, with its origin at (0, 0).

    Raises:
        InvalidParameter: A size or the seed is out of range.
    """
    rng = random_generator(seed)
    rows, columns = grid_shape(width, height, resolution)
    require_extent("a maze", width, height, WALL + _PITCH)
    if resolution > WALL:
        raise InvalidParameter(f"a maze needs a resolution <= {WALL} m; got {resolution}")
    free = _carve(rng, _maze_cells(height), _maze_cells(width))
    r = _slots(rows, resolution, height)
    c = _slots(columns, resolution, width)
    return OccupancyGrid(~free[np.ix_(r, c)], resolution)


def _maze_cells(size: float) -> int:
    return math.floor((size - WALL) / _PITCH + 1e-9)


def _slots(count: int, resolution: float, size: float) -> NDArray[np.intp]:
    """Index into walls (even) and passages (odd) of the maze for each map cell along one axis."""
    cells = _maze_cells(size)
    start = (size - WALL - cells * _PITCH) / 2
    # A centre on an edge belongs to the passage whatever the rounding error.
    offset = cell_centres(count, resolution) - start + 1e-9
    index, within = np.divmod(offset, _PITCH)
    slot = 2 * index + (within >= WALL)
    return np.asarray(np.clip(slot, 0, 2 * cells), dtype=np.intp)


def _carve(rng: np.random.Generator, rows: int, columns: int) -> NDArray[np.bool_]:
    """Depth-first search over (rows, columns) maze cells.

    Returns:
        (2 rows + 1, 2 columns + 1) bool, True where free: cell (i, j) is at (2i + 1, 2j + 1) and
        the wall between two cells is between their entries.
    """
    free = np.zeros((2 * rows + 1, 2 * columns + 1), bool)
    # A random order of directions a cell, tried in turn, is a random unvisited neighbour each time.
    steps = np.array([(-1, 0), (1, 0), (0, -1), (0, 1)])
    orders = rng.permuted(np.tile(np.arange(4), (rows * columns, 1)), axis=1)
    pending = [[tuple(step) for step in steps[order].tolist()] for order in orders]
    first = int(rng.integers(rows * columns))
    stack = [divmod(first, columns)]
    free[2 * stack[0][0] + 1, 2 * stack[0][1] + 1] = True
    while stack:
        i, j = stack[-1]
        if not pending[i * columns + j]:
            stack.pop()
            continue
        di, dj = pending[i * columns + j].pop()
        a, b = i + di, j + dj
        if 0 <= a < rows and 0 <= b < columns and not free[2 * a + 1, 2 * b + 1]:
            free[2 * a + 1, 2 * b + 1] = free[i + a + 1, j + b + 1] = True
            stack.append((a, b))
    return free
