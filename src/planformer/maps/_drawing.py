"""Fill simple shapes into a bool raster: a cell belongs to a shape when its centre does."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from planformer.maps._generation import cell_centres


def fill_disc(
    raster: NDArray[np.bool_],
    resolution: float,
    *,
    centre: tuple[float, float],
    radius: float,
) -> None:
    """Set the cells of a disc; lengths in metres from the corner of cell (0, 0)."""
    window, dx, dy = _window(raster, resolution, centre, radius)
    window |= dx**2 + dy**2 <= radius**2


def fill_box(
    raster: NDArray[np.bool_],
    resolution: float,
    *,
    centre: tuple[float, float],
    size: tuple[float, float],
    angle: float,
    value: bool = True,
) -> None:
    """Set the cells of a rotated rectangle.

    Args:
        raster: (H, W) bool, changed in place.
        resolution: Side of a cell in metres.
        centre: (x, y) in metres from the corner of cell (0, 0).
        size: Extent along the rectangle's own axes in metres.
        angle: Counter-clockwise rotation in rad.
        value: What to write.
    """
    half_x, half_y = size[0] / 2, size[1] / 2
    window, dx, dy = _window(raster, resolution, centre, math.hypot(half_x, half_y))
    c, s = math.cos(angle), math.sin(angle)
    inside = (abs(c * dx + s * dy) <= half_x) & (abs(c * dy - s * dx) <= half_y)
    window[inside] = value


def _window(
    raster: NDArray[np.bool_], resolution: float, centre: tuple[float, float], reach: float
) -> tuple[NDArray[np.bool_], NDArray[np.float64], NDArray[np.float64]]:
    """The part of the raster within `reach`, with its offsets (1, w) and (h, 1) from the centre."""
    x, y = centre
    c0, r0 = (max(math.floor((v - reach) / resolution), 0) for v in (x, y))
    c1, r1 = (max(math.floor((v + reach) / resolution) + 1, 0) for v in (x, y))
    window = raster[r0:r1, c0:c1]
    rows, columns = window.shape
    dx = cell_centres(columns, resolution) + (c0 * resolution - x)
    dy = cell_centres(rows, resolution) + (r0 * resolution - y)
    return window, dx[None, :], dy[:, None]
