"""The square map on which NEXT plans, and the coordinates of its states."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray


def square_side(blocked: NDArray[np.bool_], resolution: float) -> float:
    """Side in metres of the smallest square round a map."""
    return float(max(blocked.shape) * resolution)


def normalised(points: ArrayLike, side: float) -> NDArray[np.float32]:
    """(..., 2) float32 coordinates from -1 to 1 over the square, of metres in the map's frame."""
    return np.asarray(2.0 / side * np.asarray(points) - 1.0, np.float32)


def free_parts(blocked: NDArray[np.bool_], cells: int) -> NDArray[np.float32]:
    """The free part of the cells of a coarse square map.

    A map of any size becomes a square, blocked where it reaches beyond the map. The published
    map is binary; parts keep walls and passages that are narrower than a cell apart.

    Args:
        blocked: (H, W) bool, row 0 = lowest y.
        cells: Side w of the coarse map.

    Returns:
        (w, w) float32 from 0 to 1, row 0 = lowest y.
    """
    rows, columns = (_shares(size, max(blocked.shape), cells) for size in blocked.shape)
    parts: NDArray[np.float32] = rows @ (~blocked).astype(np.float32) @ columns.T
    return parts


def _shares(size: int, padded: int, cells: int) -> NDArray[np.float32]:
    """(cells, size): the part of each coarse cell that each of the first `size` pixels fills."""
    extent = padded / cells
    first = np.arange(cells)[:, None] * extent
    pixel = np.arange(size)[None, :]
    overlap = np.minimum(first + extent, pixel + 1) - np.maximum(first, pixel)
    return np.asarray(np.maximum(overlap, 0.0) / extent, np.float32)
