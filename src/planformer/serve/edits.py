"""Strokes of a round brush over a map."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from planformer.errors import InvalidParameter, TooLarge
from planformer.geometry import distance_to_polyline
from planformer.maps import OccupancyGrid
from planformer.serve.requests import Stroke

_CELLS_AT_MOST = 100_000_000
"""Cells that all pieces of the strokes may look at together: a second's work."""


def edit(grid: OccupancyGrid, strokes: list[Stroke]) -> OccupancyGrid:
    """The map with strokes drawn on it; a cell belongs to a stroke when its centre does.

    Raises:
        TooLarge: The strokes are too much work.
        InvalidParameter: A stroke is not on the map.
    """
    occupied, unknown = grid.occupied.copy(), grid.unknown.copy()
    work = 0
    for stroke in strokes:
        with np.errstate(over="ignore", invalid="ignore"):  # infinity is far as well
            points = grid.frame.to_local(np.array(stroke.points)) / grid.resolution
        radius = stroke.radius / grid.resolution
        _check_near(points, grid.shape)
        for piece in _pieces(points):
            window = _window(piece, radius, grid.shape)
            work += occupied[window].size
            if work > _CELLS_AT_MOST:
                raise TooLarge("these strokes cover too many cells; draw fewer or thinner ones")
            inside = _inside(piece, radius, window)
            occupied[window][inside] = stroke.occupied
            unknown[window][inside] = False
    return OccupancyGrid(occupied, grid.resolution, grid.origin, unknown)


def _check_near(points: NDArray[np.float64], shape: tuple[int, int]) -> None:
    if not (np.abs(points) <= 10.0 * max(shape)).all():
        raise InvalidParameter("a stroke is far from the map")


def _pieces(points: NDArray[np.float64]) -> list[NDArray[np.float64]]:
    """The segments of a polyline; a point alone is a piece."""
    if len(points) == 1:
        return [points]
    return [points[i : i + 2] for i in range(len(points) - 1)]


def _window(
    piece: NDArray[np.float64], radius: float, shape: tuple[int, int]
) -> tuple[slice, slice]:
    """Rows and columns of the cells that may be within the radius of a piece, in cells."""
    size = shape[::-1]
    low = np.clip(np.floor(piece.min(axis=0) - radius), 0, size).astype(int)
    high = np.clip(np.ceil(piece.max(axis=0) + radius), 0, size).astype(int)
    (x0, y0), (x1, y1) = low.tolist(), high.tolist()
    return slice(y0, y1), slice(x0, x1)


def _inside(
    piece: NDArray[np.float64], radius: float, window: tuple[slice, slice]
) -> NDArray[np.bool_]:
    rows, columns = window
    y, x = np.mgrid[rows, columns] + 0.5
    distance = distance_to_polyline(np.stack((x.ravel(), y.ravel()), axis=-1), piece)
    return np.asarray(distance.reshape(x.shape) <= radius)
