"""Whether two pixels are joined, with NumPy alone."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def connected(free: NDArray[np.bool_], first: tuple[int, int], second: tuple[int, int]) -> bool:
    """Whether a 4-connected way through free pixels leads from one pixel to another.

    Runs of free pixels along the rows are the nodes of a graph; components merge along its edges
    by hooking and pointer jumping, in a logarithmic number of rounds (Shiloach and Vishkin, An
    O(log n) parallel connectivity algorithm, 1982).

    Args:
        free: (H, W) bool.
        first: (row, col) inside.
        second: (row, col) inside.

    Returns:
        False also where either pixel is not free.
    """
    if not (free[first] and free[second]):
        return False
    starts, ends, stride = _runs(free)
    component = _components(len(starts), *_edges(starts, ends, stride))
    pixels = [row * stride + col for row, col in (first, second)]
    a, b = np.searchsorted(starts, pixels, side="right") - 1
    return bool(component[a] == component[b])


def _runs(free: NDArray[np.bool_]) -> tuple[NDArray[np.intp], NDArray[np.intp], int]:
    """Flat [start, end) of the runs in rows that are `stride` apart."""
    stride = free.shape[1] + 1
    padded = np.zeros((free.shape[0], stride), np.int8)
    padded[:, :-1] = free
    change = np.diff(padded.ravel(), prepend=0, append=0)
    return np.flatnonzero(change == 1), np.flatnonzero(change == -1), stride


def _edges(
    starts: NDArray[np.intp], ends: NDArray[np.intp], stride: int
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Pairs of runs that overlap in neighbouring rows."""
    first = np.searchsorted(ends, starts + stride, side="right")
    count = np.maximum(np.searchsorted(starts, ends + stride, side="left") - first, 0)
    lower = np.repeat(np.arange(len(starts)), count)
    rank = np.arange(len(lower)) - np.repeat(count.cumsum() - count, count)
    return lower, np.repeat(first, count) + rank


def _components(nodes: int, left: NDArray[np.intp], right: NDArray[np.intp]) -> NDArray[np.intp]:
    """Number of each node's component: the lowest number of its nodes."""
    root = np.arange(nodes)
    while True:
        a, b = root[left], root[right]
        open_edges = a != b
        if not open_edges.any():
            return root
        a, b = a[open_edges], b[open_edges]
        np.minimum.at(root, np.maximum(a, b), np.minimum(a, b))
        while not np.array_equal(jumped := root[root], root):
            root = jumped
