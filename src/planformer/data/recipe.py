"""Generated maps by name: a data set stores how its maps are made, never their cells."""

from __future__ import annotations

import zlib
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from planformer.errors import InvalidParameter
from planformer.maps.forest import generate_forest
from planformer.maps.grid import OccupancyGrid
from planformer.maps.indoor import generate_indoor
from planformer.maps.maze import generate_maze

GENERATORS: dict[str, Callable[..., OccupancyGrid]] = {
    "forest": generate_forest,
    "indoor": generate_indoor,
    "maze": generate_maze,
}
"""The map generators by the name of the kind of map that they make."""


@dataclass(frozen=True)
class MapRecipe:
    """All that it takes to generate one map again.

    Attributes:
        kind: A name in `GENERATORS`.
        seed: Seed of the generator, >= 0.
        width: Extent along x in metres.
        height: Extent along y in metres.
        resolution: Side of a cell in metres.

    Raises:
        InvalidParameter: No generator has the name.
    """

    kind: str
    seed: int
    width: float
    height: float
    resolution: float

    def __post_init__(self) -> None:
        if self.kind not in GENERATORS:
            raise InvalidParameter(
                f"unknown kind of map {self.kind!r}; choose from {', '.join(sorted(GENERATORS))}"
            )

    def generate(self) -> OccupancyGrid:
        """Make the map, with its origin at (0, 0).

        Raises:
            InvalidParameter: The generator cannot make a map of this seed and size.
        """
        return GENERATORS[self.kind](
            self.seed, width=self.width, height=self.height, resolution=self.resolution
        )


def checksum(occupied: NDArray[np.bool_]) -> int:
    """CRC-32 of a map's cells, by which a changed generator is noticed."""
    return zlib.crc32(np.packbits(occupied).tobytes())
