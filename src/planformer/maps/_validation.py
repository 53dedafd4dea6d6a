"""Checks of the values an occupancy grid is made of."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from planformer.errors import InvalidMap, InvalidParameter

_MOST_CELLS = 2**31 - 1
"""The core numbers the cells, and those of a ring round them, with 32 bits."""
_SMALLEST_CELL, _LARGEST_CELL = 1e-6, 1e6
"""Side of a cell in metres; distances on the map fit into float32 by far."""


def as_mask(values: ArrayLike, name: str) -> NDArray[np.bool_]:
    """A C-contiguous bool copy of a two-dimensional array of bool or of 0 and 1.

    Raises:
        InvalidMap: The array is something else.
    """
    array = np.asarray(values)
    if array.ndim != 2 or array.size == 0:
        raise InvalidMap(f"{name} must be a non-empty (H, W) array; got shape {array.shape}")
    if (array.shape[0] + 2) * (array.shape[1] + 2) > _MOST_CELLS:
        raise InvalidMap(f"{name} has {array.size:,} cells; a map has fewer than {_MOST_CELLS:,}")
    if array.dtype != np.bool_:
        if array.dtype.kind not in "iuf" or not np.all((array == 0) | (array == 1)):
            raise InvalidMap(
                f"{name} must hold bool or 0 and 1 only; got other {array.dtype} values"
            )
        array = array != 0
    return np.array(array, dtype=np.bool_, order="C")


def checked_resolution(resolution: float) -> float:
    """The resolution as a float.

    Raises:
        InvalidMap: It is no number, or one that no map has.
    """
    try:
        value = float(resolution)
    except (OverflowError, TypeError, ValueError):
        raise InvalidMap(f"resolution must be a number of metres; got {resolution!r}") from None
    if not _SMALLEST_CELL <= value <= _LARGEST_CELL:  # also NaN
        raise InvalidMap(
            f"resolution must be between {_SMALLEST_CELL:g} and {_LARGEST_CELL:g} m; got {value:g}"
        )
    return value


def checked_origin(origin: Sequence[float]) -> tuple[float, float, float]:
    """The origin as (x, y, yaw); yaw is 0 where none is given.

    Raises:
        InvalidMap: It is not two or three finite numbers.
    """
    try:
        values = [float(v) for v in origin]
    except (OverflowError, TypeError, ValueError):
        values = []
    if len(values) not in (2, 3) or not all(map(math.isfinite, values)):
        raise InvalidMap(f"origin must be (x, y) or (x, y, yaw), all finite; got {origin!r}")
    x, y, yaw = [*values, 0.0][:3]
    return x, y, yaw


def as_xy(xy: ArrayLike) -> NDArray[np.float64]:
    """Points (..., 2) as float64.

    Raises:
        InvalidParameter: The last axis is not 2 long.
    """
    points = np.asarray(xy, dtype=np.float64)
    if points.ndim == 0 or points.shape[-1] != 2:
        raise InvalidParameter(f"points must have shape (..., 2); got {points.shape}")
    return points
