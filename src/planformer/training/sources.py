"""Where the problems come from: one data set or several."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate
from pathlib import Path
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from planformer.data.dataset import PathDataset, PathProblem
from planformer.data.spec import MANIFEST, DatasetSpec
from planformer.errors import InvalidDataset
from planformer.training.augmentation import Example


class MapFacts(Protocol):
    """What a training needs to know of a map beside its cells."""

    @property
    def kind(self) -> str:
        """Name of the kind of map, by which validations are broken down."""

    @property
    def resolution(self) -> float:
        """Side of a cell in metres."""


class PathSource(Protocol):
    """Solved problems on maps; `planformer.data.dataset.PathDataset` is one."""

    @property
    def spec(self) -> DatasetSpec | JoinedSpec:
        """The settings that the data set was made with."""

    @property
    def recipes(self) -> Sequence[MapFacts]:
        """The maps."""

    def __len__(self) -> int: ...

    def __getitem__(self, index: int, /) -> PathProblem: ...

    def blocked_map(self, map_id: int, /) -> NDArray[np.bool_]:
        """(H, W) bool, where the robot's centre must not be."""


@dataclass(frozen=True)
class JoinedSpec:
    """The settings of several data sets that are used as one."""

    parts: tuple[DatasetSpec | JoinedSpec, ...]


class JoinedPaths:
    """Several data sets as one, their problems one after the other.

    Args:
        parts: The data sets, at least one.
    """

    def __init__(self, parts: Sequence[PathSource]) -> None:
        self._parts = parts
        self._problems = list(accumulate(map(len, parts)))
        self._maps = list(accumulate(len(part.recipes) for part in parts))
        self.spec = JoinedSpec(tuple(part.spec for part in parts))
        self.recipes = tuple(recipe for part in parts for recipe in part.recipes)

    def __len__(self) -> int:
        return self._problems[-1]

    def __getitem__(self, index: int) -> PathProblem:
        part, within = _place(self._problems, index)
        problem = self._parts[part][within]
        return problem._replace(map_id=problem.map_id + [0, *self._maps][part])

    def blocked_map(self, map_id: int) -> NDArray[np.bool_]:
        """(H, W) bool, where the robot's centre must not be."""
        part, within = _place(self._maps, map_id)
        return self._parts[part].blocked_map(within)


def _place(ends: list[int], index: int) -> tuple[int, int]:
    """Number of the part that an index falls into, and the index in that part."""
    if not 0 <= index < ends[-1]:
        raise IndexError(f"number {index} of {ends[-1]}")
    part = bisect_right(ends, index)
    return part, index - [0, *ends][part]


def open_paths(folder: Path) -> PathSource:
    """Open a data set, or all that lie in a folder as one: of several sizes, for example.

    Raises:
        InvalidDataset: There is none, or one is damaged.
    """
    if (folder / MANIFEST).exists():
        return PathDataset(folder)
    parts = sorted(path.parent for path in folder.glob(f"*/{MANIFEST}"))
    if not parts:
        raise InvalidDataset(f"{folder} is no data set and holds none: there is no {MANIFEST}")
    return JoinedPaths([PathDataset(part) for part in parts])


def load_example(source: PathSource, index: int) -> Example:
    """Problem number `index` with its map."""
    problem = source[index]
    blocked = source.blocked_map(problem.map_id)
    resolution = source.recipes[problem.map_id].resolution
    return Example(blocked, resolution, problem.start, problem.goal, problem.path)
