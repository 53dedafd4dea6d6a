"""Reading a data set of expert paths, with NumPy and pyarrow alone."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from planformer.data.arcs import driven_poses
from planformer.data.inflation import inflate
from planformer.data.recipe import AnyMap, MapRecipe, StoredMap, checksum, map_seeds
from planformer.data.shards import Shard, read_shard
from planformer.data.spec import DatasetSpec, read_spec
from planformer.errors import InvalidDataset


class PathProblem(NamedTuple):
    """A planning problem and the expert's solution, in the map's local frame.

    Attributes:
        map_id: Index of the map in `PathDataset.recipes`.
        start: (2,) float64 x and y in metres, for a car (3,) with yaw in rad.
        goal: As the start.
        path: (N, 2) or (N, 3) float64 vertices from start to goal, N >= 2; a car's poses are at
            most half a cell apart on arcs, so that it is a polyline for all purposes.
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
        recipes: The maps. Each has a `kind`, a `resolution` in metres and a `shape` (H, W), which
            differ from map to map where users' own maps are among them.
        map_ids: (P,) int64, the map of each problem, read-only.
        unsolved: (M,) int64, problems drawn on each map that the expert found no path for.

    Raises:
        InvalidDataset: The folder is not a data set, or a shard is missing or damaged.
    """

    spec: DatasetSpec
    recipes: tuple[AnyMap, ...]
    map_ids: NDArray[np.int64]
    unsolved: NDArray[np.int64]

    def __init__(self, folder: str | Path) -> None:
        folder = Path(folder)
        self.spec = read_spec(folder)
        shards = _read_shards(folder, self.spec)
        self.recipes = tuple(recipe for shard in shards for recipe in shard.recipes)
        self._checksums = np.concatenate([shard.checksums for shard in shards])
        self.unsolved = np.concatenate([shard.unsolved for shard in shards]).astype(np.int64)
        self.map_ids = _joined([s.map_index for s in shards], [len(s.recipes) for s in shards])
        firsts = [shard.offsets[:-1] for shard in shards]
        self._vertices = np.concatenate([shard.vertices for shard in shards])
        self._first = _joined(firsts, [len(shard.vertices) for shard in shards])
        self._after_last = np.append(self._first[1:], len(self._vertices))
        for array in (self.map_ids, self.unsolved, self._vertices):
            array.setflags(write=False)
        self._packed: dict[int, NDArray[np.uint8]] = {}

    def __len__(self) -> int:
        return len(self.map_ids)

    def __getitem__(self, index: int) -> PathProblem:
        if not -len(self) <= index < len(self):
            raise IndexError(f"problem {index} of a data set of {len(self)}")
        path = self._vertices[self._first[index] : self._after_last[index]]
        map_id = int(self.map_ids[index])
        start, goal = path[0], path[-1]
        if path.shape[1] == 3:
            path = driven_poses(path, 0.5 * self.recipes[map_id].resolution)
            path.setflags(write=False)
        return PathProblem(map_id, start, goal, path)

    def blocked_map(self, map_id: int) -> NDArray[np.bool_]:
        """The map inflated by the robot's radius: True where the robot may not be.

        Args:
            map_id: Index of the map in `recipes`.

        Returns:
            (H, W) bool, row 0 = lowest y; equal to `OccupancyGrid.blocked`.

        Raises:
            InvalidDataset: The generator no longer makes the map that the paths were found on.
        """
        if map_id not in self._packed:
            self._packed[map_id] = np.packbits(self._make_blocked(map_id), axis=1)
        width = self.recipes[map_id].shape[1]
        return np.unpackbits(self._packed[map_id], axis=1, count=width).view(np.bool_)

    def _make_blocked(self, map_id: int) -> NDArray[np.bool_]:
        recipe = self.recipes[map_id]
        occupied = recipe.grid().occupied
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
    paths = np.bincount(shard.map_index, minlength=len(shard.recipes))
    for what, found, expected in (
        ("kind of map", shard.recipes[0].kind, kind),
        ("number of maps", len(shard.recipes), len(indices)),
        ("robot", shard.robot, spec.make_robot()),
        ("numbers of paths a map", set(paths.tolist()), {spec.paths_per_map}),
        ("maps", _identities(shard), _expected_identities(spec, kind, indices)),
    ):
        if found != expected:
            raise InvalidDataset(
                f"the shard {path} is of another data set: {what} {found!r:.200}; expected "
                f"{expected!r:.200}"
            )
    return shard


def _identities(shard: Shard) -> list[tuple[object, ...]]:
    """What the settings say of the maps: how generated ones are made, names of users' own."""
    return [
        (recipe.seed, recipe.width, recipe.height, recipe.resolution)
        if isinstance(recipe, MapRecipe)
        else (recipe.name, int(check))
        for recipe, check in zip(shard.recipes, shard.checksums, strict=True)
    ]


def _expected_identities(spec: DatasetSpec, kind: str, indices: range) -> list[tuple[object, ...]]:
    if kind == StoredMap.kind:
        return list(spec.user_maps[indices.start : indices.stop])
    size = (spec.width, spec.height, spec.resolution)
    return [(map_seeds(spec.seed, kind, number)[0], *size) for number in indices]


def _joined(indices: list[NDArray[np.int64]], counts: list[int]) -> NDArray[np.int64]:
    """Concatenate index arrays that each count from 0, each with `counts` targets of its own."""
    starts = np.cumsum([0, *counts[:-1]])
    return np.concatenate([part + start for part, start in zip(indices, starts, strict=True)])
