"""The maps of a data set: how a generated one is made again, and how a user's own is kept."""

from __future__ import annotations

import zlib
from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar, TypeAlias

import numpy as np
from numpy.typing import NDArray

from planformer.errors import InvalidDataset, InvalidParameter
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

USER_KIND = "user"
"""The kind of the maps that users bring along."""


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

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns, (H, W)."""
        return round(self.height / self.resolution), round(self.width / self.resolution)

    def grid(self) -> OccupancyGrid:
        """Generate the map, with its origin at (0, 0).

        Raises:
            InvalidParameter: The generator cannot make a map of this seed and size.
        """
        return GENERATORS[self.kind](
            self.seed, width=self.width, height=self.height, resolution=self.resolution
        )


@dataclass(frozen=True)
class StoredMap:
    """A user's map with its cells, one bit each.

    Attributes:
        name: Its file, relative to the folder that the maps were read from.
        shape: Rows and columns, (H, W).
        resolution: Side of a cell in metres.
        packed: `numpy.packbits` of the occupied cells, row after row from the lowest y.

    Raises:
        InvalidDataset: The number of bytes does not fit the shape.
    """

    kind: ClassVar[str] = USER_KIND

    name: str
    shape: tuple[int, int]
    resolution: float
    packed: bytes

    def __post_init__(self) -> None:
        rows, columns = self.shape
        if len(self.packed) != -(-rows * columns // 8):
            raise InvalidDataset(
                f"the map {self.name} of {columns} x {rows} cells has {len(self.packed)} bytes"
            )

    @classmethod
    def of(cls, name: str, grid: OccupancyGrid) -> StoredMap:
        """Pack a map; where it lies in the world is left out."""
        return cls(name, grid.shape, grid.resolution, np.packbits(grid.occupied).tobytes())

    @property
    def width(self) -> float:
        """Extent along x in metres."""
        return self.shape[1] * self.resolution

    @property
    def height(self) -> float:
        """Extent along y in metres."""
        return self.shape[0] * self.resolution

    def grid(self) -> OccupancyGrid:
        """Unpack the map, with its origin at (0, 0)."""
        rows, columns = self.shape
        cells = np.unpackbits(np.frombuffer(self.packed, np.uint8), count=rows * columns)
        return OccupancyGrid(cells.reshape(self.shape).view(np.bool_), self.resolution)


def map_seeds(seed: int, kind: str, number: int) -> tuple[int, int, int]:
    """The seeds of map number `number` of a kind: of the map, its problems and their expert.

    Args:
        seed: Seed of the data set.
        kind: The kind of map.
        number: The map's number among those of its kind.
    """
    sequence = np.random.SeedSequence(seed, spawn_key=(zlib.crc32(kind.encode()), number))
    of_map, of_problems, of_expert = (int(s) for s in sequence.generate_state(3, np.uint64))
    return of_map, of_problems, of_expert


AnyMap: TypeAlias = MapRecipe | StoredMap


def checksum(occupied: NDArray[np.bool_]) -> int:
    """CRC-32 of a map's cells, by which a changed generator is noticed."""
    return zlib.crc32(np.packbits(occupied).tobytes())
