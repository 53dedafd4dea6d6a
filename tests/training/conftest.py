from __future__ import annotations

import numpy as np
import pytest

from planformer.data.dataset import PathProblem
from planformer.data.recipe import MapRecipe
from planformer.data.spec import DatasetSpec

SIDE = 6.0


class StraightPaths:
    """Straight paths on small maps that have a wall at the right: a `PathSource` in memory."""

    def __init__(self, count, seed=0):
        rng = np.random.default_rng(seed)
        self.spec = DatasetSpec(kinds=("forest",), maps=1, paths_per_map=count, seed=seed)
        self.recipes = (MapRecipe("forest", 0, SIDE, SIDE, 0.05),)
        self._ends = rng.uniform(0.2, SIDE - 1.2, (count, 2, 2))

    def __len__(self):
        return len(self._ends)

    def __getitem__(self, index):
        start, goal = self._ends[index]
        return PathProblem(0, start, goal, self._ends[index])

    def blocked_map(self, map_id):
        assert map_id == 0
        blocked = np.zeros((120, 120), bool)
        blocked[:, 100:] = True
        return blocked


class CarPaths(StraightPaths):
    """The same paths for a car that drives straight on."""

    def __getitem__(self, index):
        problem = super().__getitem__(index)
        yaw = np.arctan2(*(problem.goal - problem.start)[::-1])
        path = np.column_stack([problem.path, [yaw, yaw]])
        return problem._replace(start=path[0], goal=path[-1], path=path)


@pytest.fixture
def straight_paths():
    return StraightPaths


@pytest.fixture
def car_paths():
    return CarPaths
