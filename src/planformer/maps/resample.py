"""Bring the cells of a map to another resolution without losing obstacles."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

_EDGE_TOLERANCE = 1e-6
"""In cells: 0.15 / 0.05 is meant to be three."""


def resample_masks(
    occupied: NDArray[np.bool_], unknown: NDArray[np.bool_], ratio: float
) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Occupied and unknown cells at another resolution.

    Args:
        occupied: (H, W) bool.
        unknown: (H, W) bool.
        ratio: Side of a new cell over the side of an old one, > 0.

    Returns:
        The new masks. Above ratio 1, a new cell is occupied if any cell it overlaps is, unknown if
        any is and none was seen occupied; below 1 it is what the cell at its centre is.
    """
    if ratio <= 1.0:
        return _finer(occupied, ratio), _finer(unknown, ratio)
    seen_occupied = any_overlapped(occupied & ~unknown, ratio, outside=False)
    return (
        any_overlapped(occupied, ratio, outside=True),
        any_overlapped(unknown, ratio, outside=False) & ~seen_occupied,
    )


def any_overlapped(mask: NDArray[np.bool_], ratio: float, *, outside: bool) -> NDArray[np.bool_]:
    """Any over the cells that each new cell overlaps.

    Args:
        mask: (H, W) bool.
        ratio: Side of a new cell over the side of an old one, > 0.
        outside: What holds beside the map.

    Returns:
        (H', W') bool, see `resampled_size`.
    """
    for _ in range(2):
        mask = _any_along_rows(mask, ratio, outside).T
    return mask


def _any_along_rows(mask: NDArray[np.bool_], ratio: float, outside: bool) -> NDArray[np.bool_]:
    size, columns = mask.shape
    edges = np.arange(resampled_size(size, ratio) + 1) * ratio
    first = np.floor(edges[:-1] + _EDGE_TOLERANCE).astype(np.intp)
    end = np.ceil(edges[1:] - _EDGE_TOLERANCE)
    sums = np.zeros((size + 1, columns), np.int32)
    np.cumsum(mask, axis=0, out=sums[1:])
    result: NDArray[np.bool_] = sums[np.minimum(end, size).astype(np.intp)] > sums[first]
    if outside and end[-1] > size:
        result[-1] = True
    return result


def _finer(mask: NDArray[np.bool_], ratio: float) -> NDArray[np.bool_]:
    """The nearest old cell for each new one; the last may have its centre beyond the map."""
    rows, columns = (
        np.minimum(((np.arange(count) + 0.5) * ratio).astype(np.intp), size - 1)
        for size, count in ((size, resampled_size(size, ratio)) for size in mask.shape)
    )
    return mask[np.ix_(rows, columns)]


def resampled_size(size: int, ratio: float) -> int:
    """New cells needed to cover `size` old ones along a side."""
    return max(1, math.ceil(size / ratio - _EDGE_TOLERANCE))
