"""What all map generators share: checks of seed and size, and drawing at cell centres."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from planformer.errors import InvalidParameter

MAX_CELLS = 2**28
"""Largest generated map: beyond it a slip in the resolution would take the machine's memory."""

Seed = int | np.random.Generator


def random_generator(seed: Seed) -> np.random.Generator:
    """The generator for a seed; one that is passed in is used as it is.

    Raises:
        InvalidParameter: The seed is neither an integer >= 0 nor a NumPy Generator.
    """
    if isinstance(seed, np.random.Generator):
        return seed
    if isinstance(seed, (int, np.integer)) and seed >= 0:
        return np.random.default_rng(int(seed))
    raise InvalidParameter(f"seed must be an integer >= 0 or a numpy Generator; got {seed!r}")


def grid_shape(width: float, height: float, resolution: float) -> tuple[int, int]:
    """Rows and columns of a map of the given extent in metres, rounded to whole cells.

    Raises:
        InvalidParameter: A value is not finite and positive, or the map has too many cells.
    """
    for name, value in (("width", width), ("height", height), ("resolution", resolution)):
        if not (math.isfinite(value) and value > 0):
            raise InvalidParameter(f"{name} must be finite and > 0 m; got {value}")
    rows, columns = round(height / resolution), round(width / resolution)
    if rows < 1 or columns < 1:
        raise InvalidParameter(
            f"a map of {width} x {height} m is smaller than one cell of {resolution} m"
        )
    if rows * columns > MAX_CELLS:
        raise InvalidParameter(
            f"{columns} x {rows} cells are more than the {MAX_CELLS} a generated map may have; "
            "choose a larger resolution"
        )
    return rows, columns


def require_extent(kind: str, width: float, height: float, minimum: float) -> None:
    """Check that both sides have room for what is generated.

    Raises:
        InvalidParameter: A side is shorter than `minimum` metres.
    """
    if min(width, height) < minimum * (1.0 - 1e-9):
        raise InvalidParameter(
            f"{kind} needs at least {minimum:g} x {minimum:g} m; got {width:g} x {height:g} m"
        )


def cell_centres(count: int, resolution: float) -> NDArray[np.float64]:
    """(count,) coordinates of the cell centres along one axis in metres."""
    return np.asarray((np.arange(count) + 0.5) * resolution)
