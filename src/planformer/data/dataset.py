"""Reading a data set of expert paths, with NumPy alone."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from planformer.data.inflation import inflate
from planformer.data.recipe import MapRecipe, checksum
from planformer.data.shards import Shard, read_shard
from planformer.data.spec import DatasetSpec, read_spec
from planformer.errors import InvalidDataset


class PathProblem(NamedTuple):
    """A planning problem and the expert's solution.

    Attributes:
        map_id: Index of the map in `PathDataset.recipes`.
        start: (2,) float64, x and y in metres, world frame.
        goal: (2,) float64.
        path: (N, 2) float64 vertices from start to goal, N >= 2.
    """

    map_id: int
    start: NDArray[np.float64]
    goal: NDArray[np.float64]
    path: NDArray[np.float64]


class PathDataset:
    """A data set made by `planformer.data.generate.generate_dataset`.

    A sequence of `PathProblem`. The paths are read at once; maps are generated when they are
    asked for and kept in memory with one bit a cell (29 kB for 480 x 480), so that only the first
    access to each costs more than unpacking.

    Args:
        folder: Folder of the data set.

    Attributes:
        spec: The settings that the data set was made with.
        recipes: The maps.
        map_ids: (P,) int64, the map of each problem, read-only.

    Raises:
        InvalidDataset: The folder is not a data set, or a shard is missing or damaged.
    """

    spec: DatasetSpec
    recipes: tuple[MapRecipe, ...]
    map_ids: NDArray[np.int64]

    def __init__(self, folder: str | Path) -> None:
        folder = Path(folder)
        self.spec = read_spec(folder)
        shards = _read_shards(folder, self.spec)
        self.recipes = tuple(recipe for shard in shards for recipe in shard.recipes)
        self._checksums = np.concatenate([shard.checksums for shard in shards])
        self.map_ids = _joined([s.map_index for s in shards], [len(s.recipes) for s in shards])
        firsts = [shard.offsets[:-1] for shard in shards]
        self._vertices = np.concatenate([shard.vertices for shard in shards])
        self._first = _joined(firsts, [len(shard.vertices) for shard in shards])
        self._after_last = np.append(self._first[1:], len(self._vertices))
        for array in (self.map_ids, self._vertices):
            array.setflags(write=False)
        self._packed: dict[int, NDArray[np.uint8]] = {}

    def __len__(self) -> int:
        return len(self.map_ids)

    def __getitem__(self, index: int) -> PathProblem:
        if not -len(self) <= index < len(self):
            raise IndexError(f"problem {index} of a data set of {len(self)}")
        path = self._vertices[self._first[index] : self._after_last[index]]
        return PathProblem(int(self.map_ids[index]), path[0], path[-1], path)

    def blocked_map(self, map_id: int) -> NDArray[np.bool_]:
        """The map inflated by the robot's radius: True where the robot may not be.

        Args:
            map_id: Index of the map in `recipes`.

        Returns:
            (H, W) bool, row 0 = lowest y; equal to `OccupancyGrid.blocked`.

        Raises:
            InvalidDataset: The generator no longer makes the map that the paths were found on.
        """
        recipe = self.recipes[map_id]
        if map_id not in self._packed:
            self._packed[map_id] = np.packbits(self._make_blocked(map_id), axis=1)
        width = round(recipe.width / recipe.resolution)
        return np.unpackbits(self._packed[map_id], axis=1, count=width).view(np.bool_)

    def _make_blocked(self, map_id: int) -> NDArray[np.bool_]:
        recipe = self.recipes[map_id]
        occupied = recipe.generate().occupied
        if checksum(occupied) != self._checksums[map_id]:
            raise InvalidDataset(
                f"the generator makes another map of {recipe} than when the data set was made; "
                "generate the data set again"
            )
        return inflate(occupied, recipe.resolution, self.spec.robot_radius)


def _read_shards(folder: Path, spec: DatasetSpec) -> list[Shard]:
    expected = spec.shards()
    missing = [name for name in expected if not (folder / name).exists()]
    if missing:
        raise InvalidDataset(
            f"{folder} lacks {len(missing)} of {len(expected)} shards ({missing[0]}, ...); "
            "generate it again with the same settings to complete it"
        )
    return [_read_fitting(folder / name, spec, *at) for name, at in expected.items()]


def _read_fitting(path: Path, spec: DatasetSpec, kind: str, indices: range) -> Shard:
    """Read a shard and check that it belongs to the data set."""
    shard = read_shard(path)
    first = shard.recipes[0]
    found = (first.kind, first.width, first.height, first.resolution, shard.robot_radius)
    expected = (kind, spec.size, spec.size, spec.resolution, spec.robot_radius)
    maps, paths = len(shard.recipes), len(shard.map_index)
    if found != expected or maps != len(indices) or paths != maps * spec.paths_per_map:
        raise InvalidDataset(
            f"the shard {path} is of another data set: {paths} paths on {maps} maps with (kind, "
            f"width, height, resolution, robot radius) {found}; expected "
            f"{len(indices) * spec.paths_per_map} on {len(indices)} with {expected}"
        )
    return shard


def _joined(indices: list[NDArray[np.int64]], counts: list[int]) -> NDArray[np.int64]:
    """Concatenate index arrays that each count from 0, each with `counts` targets of its own."""
    starts = np.cumsum([0, *counts[:-1]])
    return np.concatenate([part + start for part, start in zip(indices, starts, strict=True)])
