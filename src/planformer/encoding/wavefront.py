"""Geodesic distance on a grid: the compiled search, or NumPy where it is not built."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

try:
    from planformer import _core
except ImportError:  # a checkout that only trains networks has no compiled core
    _core = None  # type: ignore[assignment]


def wavefront(blocked: NDArray[np.bool_], cell: tuple[int, int]) -> NDArray[np.float32]:
    """Distance from one cell to all others on the 8-connected grid.

    A straight step costs 1, a diagonal one sqrt(2), and only between two free side cells.

    Args:
        blocked: (H, W) bool.
        cell: (row, col) of the source, inside the grid; a wave leaves it even if it is blocked.

    Returns:
        (H, W) float32 distances in cells, infinity where no path leads.
    """
    if _core is None:
        return relaxed_wavefront(blocked, cell)
    return _core.wavefront(np.ascontiguousarray(blocked), *cell)


def relaxed_wavefront(blocked: NDArray[np.bool_], cell: tuple[int, int]) -> NDArray[np.float32]:
    """`wavefront` in NumPy: relax all steps out of the cells that changed until none does."""
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
    inside: NDArray[np.float32] = distance.reshape(free.shape)[1:-1, 1:-1].astype(np.float32)
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
