"""Random Forest maps: circles and rotated squares, as in the MPT paper's experiments."""

from __future__ import annotations

import math

import numpy as np

from planformer.errors import InvalidParameter
from planformer.maps._drawing import fill_box, fill_disc
from planformer.maps._generation import (
    MAX_CELLS,
    Seed,
    grid_shape,
    random_generator,
    require_extent,
)
from planformer.maps.grid import OccupancyGrid

CIRCLE_RADIUS = 0.75
SQUARE_SIDE = 1.5
CIRCLES_PER_SQUARE_METRE = 70 / 576
SQUARES_PER_SQUARE_METRE = 30 / 576
MARGIN = 0.5
"""Obstacle centres keep this distance in metres from the map's edge."""


def generate_forest(
    seed: Seed,
    *,
    width: float = 24.0,
    height: float = 24.0,
    resolution: float = 0.05,
    circles: int | None = None,
    squares: int | None = None,
) -> OccupancyGrid:
    """Generate a Random Forest map.

    Circles of radius 0.75 m and squares of side 1.5 m at random rotation; centres uniform at
    least 0.5 m inside the map; a border one cell wide. Johnson et al., Motion Planning
    Transformers, section IV.A. A cell is occupied when its centre lies in an obstacle.

    Args:
        seed: Integer >= 0 or NumPy Generator; the same seed gives the same map.
        width: Extent along x in metres, more than 1 m.
        height: Extent along y in metres, more than 1 m.
        resolution: Side of a cell in metres.
        circles: Number of circles; the paper's density, 70 per 576 m^2, by default.
        squares: Number of squares; the paper's density, 30 per 576 m^2, by default.

    Returns:
        The map, with its origin at (0, 0).

    Raises:
        InvalidParameter: A size, a count or the seed is out of range.
    """
    rng = random_generator(seed)
    shape = grid_shape(width, height, resolution)
    require_extent("a forest", width, height, 2 * MARGIN)
    n_circles = _count("circles", circles, CIRCLES_PER_SQUARE_METRE * width * height)
    n_squares = _count("squares", squares, SQUARES_PER_SQUARE_METRE * width * height)
    centres = rng.uniform(
        (MARGIN, MARGIN), (width - MARGIN, height - MARGIN), (n_circles + n_squares, 2)
    )
    angles = rng.uniform(0.0, math.pi / 2, n_squares)

    occupied = np.zeros(shape, bool)
    for x, y in centres[:n_circles].tolist():
        fill_disc(occupied, resolution, centre=(x, y), radius=CIRCLE_RADIUS)
    for (x, y), angle in zip(centres[n_circles:].tolist(), angles.tolist(), strict=True):
        side = (SQUARE_SIDE, SQUARE_SIDE)
        fill_box(occupied, resolution, centre=(x, y), size=side, angle=angle)
    occupied[[0, -1], :] = True
    occupied[:, [0, -1]] = True
    return OccupancyGrid(occupied, resolution)


def _count(name: str, given: int | None, default: float) -> int:
    if given is None:
        if default > MAX_CELLS:
            raise InvalidParameter(f"a forest of this size has {default:.3g} {name}: too many")
        return round(default)
    if given < 0:
        raise InvalidParameter(f"{name} must be >= 0; got {given}")
    return given
