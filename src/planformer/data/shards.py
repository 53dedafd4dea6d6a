"""Shards: the files that hold a data set's maps and paths. The file format is known here alone.

A shard is an uncompressed NumPy .npz archive of M maps of one kind and P paths on them:

    kind           ()          str, the maps' generator
    seed           (M,)        uint64, the generator's seed for each map
    checksum       (M,)        uint32, `planformer.data.recipe.checksum` of each map's cells
    size           (2,)        float64, extent of a map along x and y in metres
    resolution     ()          float64, side of a cell in metres
    robot_radius   ()          float64, radius in metres of the robot that the paths are for
    map_index      (P,)        int64, the map of each path, counted from 0 in this shard
    offset         (P + 1,)    int64, path i is vertex[offset[i]:offset[i + 1]]
    vertex         (V, 2)      float64, the vertices (x, y) of all paths in metres, world frame

A problem's start and goal are the first and the last vertex of its path.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from planformer.data.recipe import MapRecipe
from planformer.errors import InvalidDataset
from planformer.files import whole_file


class MapPaths(NamedTuple):
    """A map and the paths on it.

    Attributes:
        recipe: The map.
        checksum: Of the map's cells, see `planformer.data.recipe.checksum`.
        paths: Paths of shape (N, 2), N >= 2, in metres, world frame.
    """

    recipe: MapRecipe
    checksum: int
    paths: Sequence[NDArray[np.float64]]


@dataclass(frozen=True, eq=False)
class Shard:
    """Maps and the paths on them.

    Attributes:
        recipes: The M maps, at least one; all of one kind, size and resolution.
        checksums: (M,) uint32, of the cells of each map.
        robot_radius: Radius in metres of the robot that the paths are for.
        map_index: (P,) int64, the map of each path.
        offsets: (P + 1,) int64, path i is `vertices[offsets[i]:offsets[i + 1]]`.
        vertices: (V, 2) float64, the vertices of all paths in metres, world frame.

    Raises:
        InvalidDataset: The arrays do not fit together.
    """

    recipes: tuple[MapRecipe, ...]
    checksums: NDArray[np.uint32]
    robot_radius: float
    map_index: NDArray[np.int64]
    offsets: NDArray[np.int64]
    vertices: NDArray[np.float64]

    def __post_init__(self) -> None:
        paths, maps, vertices = len(self.map_index), len(self.recipes), len(self.vertices)
        for rule, holds in (
            ("a map", maps > 0),
            ("a checksum a map", self.checksums.shape == (maps,)),
            ("vertices of shape (V, 2)", self.vertices.shape == (vertices, 2)),
            ("finite vertices", np.isfinite(self.vertices).all()),
            ("map indices of shape (P,)", self.map_index.shape == (paths,)),
            ("map indices inside the shard", _all_in(self.map_index, 0, maps - 1)),
            ("an offset more than paths", self.offsets.shape == (paths + 1,)),
            ("offsets from 0 to V", _ends(self.offsets) == [0, vertices]),
            ("two vertices or more a path", _all_in(np.diff(self.offsets), 2, vertices)),
        ):
            if not holds:
                raise InvalidDataset(f"a shard needs {rule}")

    @classmethod
    def from_maps(cls, maps: Sequence[MapPaths], robot_radius: float) -> Shard:
        """Pack maps and their paths."""
        paths = [path for of_map in maps for path in of_map.paths]
        return cls(
            recipes=tuple(of_map.recipe for of_map in maps),
            checksums=np.array([of_map.checksum for of_map in maps], np.uint32),
            robot_radius=robot_radius,
            map_index=np.repeat(np.arange(len(maps)), [len(of_map.paths) for of_map in maps]),
            offsets=np.cumsum([0, *map(len, paths)], dtype=np.int64),
            vertices=np.concatenate(paths),
        )


def write_shard(path: Path, shard: Shard) -> None:
    """Write a shard; the file appears whole or not at all."""
    first = shard.recipes[0]
    with whole_file(path) as file:
        np.savez(
            file,
            kind=np.array(first.kind),
            seed=np.array([recipe.seed for recipe in shard.recipes], np.uint64),
            checksum=shard.checksums,
            size=np.array([first.width, first.height]),
            resolution=np.array(first.resolution),
            robot_radius=np.array(shard.robot_radius),
            map_index=shard.map_index,
            offset=shard.offsets,
            vertex=shard.vertices,
        )


def read_shard(path: Path) -> Shard:
    """Read and check a shard.

    Raises:
        InvalidDataset: The file is missing, damaged or not a shard.
    """
    try:
        with path.open("rb") as file, np.load(file, allow_pickle=False) as arrays:
            return Shard(
                recipes=_recipes(arrays),
                checksums=arrays["checksum"].astype(np.uint32, casting="safe"),
                robot_radius=float(arrays["robot_radius"]),
                map_index=arrays["map_index"].astype(np.int64, casting="safe"),
                offsets=arrays["offset"].astype(np.int64, casting="safe"),
                vertices=arrays["vertex"].astype(np.float64, casting="safe"),
            )
    except FileNotFoundError:
        raise InvalidDataset(f"the shard {path} is missing") from None
    except Exception as error:  # a damaged archive raises almost anything in zipfile and NumPy
        raise InvalidDataset(f"the shard {path} is damaged: {error}") from error


def _recipes(arrays: Mapping[str, NDArray[Any]]) -> tuple[MapRecipe, ...]:
    kind, resolution = str(arrays["kind"]), float(arrays["resolution"])
    width, height = (float(value) for value in arrays["size"])
    return tuple(MapRecipe(kind, int(seed), width, height, resolution) for seed in arrays["seed"])


def _all_in(values: NDArray[np.int64], low: int, high: int) -> bool:
    return bool(np.all((values >= low) & (values <= high)))


def _ends(offsets: NDArray[np.int64]) -> list[int]:
    return [*offsets[:1].tolist(), *offsets[-1:].tolist()]
