"""Geodesic distances on a grid: the compiled search, or NumPy where it is not built."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

try:
    from planformer import _core
except ImportError:  # a checkout that only trains networks has no compiled core
    _core = None  # type: ignore[assignment]

Cell = tuple[int, int]

_ROUNDING = 1e-6


def detours(
    blocked: NDArray[np.bool_], start: Cell, goal: Cell, limit: float, side: int
) -> NDArray[np.float32] | None:
    """How far the squares of a grid are from a start and a goal, and how far out of the way.

    Distances are geodesic on the 8-connected grid: a straight step costs 1, a diagonal one sqrt(2),
    and only between two free side cells. The detour of a cell is how much longer than the shortest
    the way through it is. A square has the least values of its cells, each for itself: a wall may
    divide them.

    Args:
        blocked: (H, W) bool.
        start: (row, col) inside the grid, free whatever the grid says.
        goal: As the start.
        limit: Largest detour, in cells, of a cell that counts.
        side: Side of a square in cells.

    Returns:
        (3, ceil(H / side), ceil(W / side)) float32 in cells: distance from the start, from the
        goal, and detour; infinite where no cell counts. None where no way joins start and goal.
    """
    if _core is None:
        return relaxed_detours(blocked, start, goal, limit, side)
    return _core.detours(np.ascontiguousarray(blocked), start, goal, limit, side)


def relaxed_detours(
    blocked: NDArray[np.bool_], start: Cell, goal: Cell, limit: float, side: int
) -> NDArray[np.float32] | None:
    """`detours` in NumPy, with waves over the whole grid."""
    blocked = blocked.copy()
    blocked[start] = blocked[goal] = False
    from_start, from_goal = (_relaxed_wavefront(blocked, cell) for cell in (start, goal))
    shortest = from_start[goal]
    if not np.isfinite(shortest):
        return None
    excess = np.maximum(from_start + from_goal - shortest, 0.0)
    counts = excess <= limit + _ROUNDING
    waves = (from_start, from_goal, excess)
    return np.stack([_least(np.where(counts, wave, np.inf), side) for wave in waves])


def _least(values: NDArray[np.float64], side: int) -> NDArray[np.float32]:
    """The smallest value in each square of `side` cells."""
    beyond = [(0, -size % side) for size in values.shape]
    padded = np.pad(values, beyond, constant_values=np.inf)
    height, width = (size // side for size in padded.shape)
    squares = padded.reshape(height, side, width, side)
    least: NDArray[np.float64] = squares.min(axis=(1, 3))
    return least.astype(np.float32)


def _relaxed_wavefront(blocked: NDArray[np.bool_], cell: Cell) -> NDArray[np.float64]:
    """(H, W) distances from a cell: relax steps out of the cells that changed until none does."""
    height, width = blocked.shape
    stride = width + 2
    free = np.zeros((height + 2, stride), bool)
    free[1:-1, 1:-1] = ~blocked
    moves, open_moves = _moves(free)
    distance = np.full(free.size, math.inf)
    frontier = np.array([(cell[0] + 1) * stride + cell[1] + 1])
    distance[frontier] = 0.0
    while frontier.size:
        changed = []
        for (offset, cost), is_open in zip(moves, open_moves, strict=True):
            origin = frontier[is_open[frontier]]
            length = distance[origin] + cost
            shorter = length < distance[origin + offset]
            target = origin[shorter] + offset
            distance[target] = length[shorter]
            changed.append(target)
        frontier = np.unique(np.concatenate(changed))
    inside: NDArray[np.float64] = distance.reshape(free.shape)[1:-1, 1:-1]
    return inside


def _moves(
    free: NDArray[np.bool_],
) -> tuple[list[tuple[int, float]], list[NDArray[np.bool_]]]:
    """The eight steps as (flat offset, cost), and for each the cells that it may leave, flat."""
    moves, open_moves = [], []
    for dr, dc in ((0, 1), (0, -1), (1, 0), (-1, 0), (1, 1), (1, -1), (-1, 1), (-1, -1)):
        may = np.roll(free, (-dr, -dc), axis=(0, 1))
        if dr and dc:
            may &= np.roll(free, -dr, axis=0) & np.roll(free, -dc, axis=1)
        moves.append((dr * free.shape[1] + dc, math.hypot(dr, dc)))
        open_moves.append(may.ravel())
    return moves, open_moves
