"""The part of a map that a picture shows: what was observed, without the unknown round it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from planformer.maps import OccupancyGrid

_MARGIN = 0.04
"""Unknown space kept on each side, as a share of the shown part's longer side."""


@dataclass(frozen=True)
class View:
    """A rectangle of cells of a map.

    Attributes:
        grid: The map.
        rows: First row and the one after the last.
        columns: First column and the one after the last.
    """

    grid: OccupancyGrid
    rows: tuple[int, int]
    columns: tuple[int, int]

    @property
    def shape(self) -> tuple[int, int]:
        """Numbers of rows and columns."""
        return self.rows[1] - self.rows[0], self.columns[1] - self.columns[0]

    @property
    def extent(self) -> tuple[float, float, float, float]:
        """Left, right, bottom and top in metres in the map's own frame."""
        resolution = self.grid.resolution
        (bottom, top), (left, right) = self.rows, self.columns
        return left * resolution, right * resolution, bottom * resolution, top * resolution

    def of(self, mask: NDArray[np.bool_]) -> NDArray[np.bool_]:
        """The part of a (H, W) mask that the view shows."""
        return mask[slice(*self.rows), slice(*self.columns)]

    def world_bounds(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Lowest and highest (x, y) of the view's corners in the world frame, metres."""
        left, right, bottom, top = self.extent
        corners = [(x, y) for x in (left, right) for y in (bottom, top)]
        world = self.grid.frame.to_world(corners)
        return world.min(axis=0), world.max(axis=0)


def make_view(grid: OccupancyGrid, points: ArrayLike) -> View:
    """The part of a map that holds all observed cells and some points.

    Args:
        grid: The map.
        points: (N, 2) world points in metres on the map, N >= 1.
    """
    known = ~grid.unknown
    cells = grid.to_rc(points)
    spans = [_span(np.asarray(known.any(axis=1 - axis)), cells[:, axis]) for axis in (0, 1)]
    margin = round(_MARGIN * max(last - first for first, last in spans)) + 1
    rows, columns = (
        (max(first - margin, 0), min(last + margin, side))
        for (first, last), side in zip(spans, grid.shape, strict=True)
    )
    return View(grid, rows, columns)


def _span(known: NDArray[np.bool_], indices: NDArray[np.int64]) -> tuple[int, int]:
    """First and one after last of the indices and of the entries that are set."""
    every = np.concatenate((np.flatnonzero(known), indices))
    return int(every.min()), int(every.max()) + 1
