"""Paths through doors for the tests of MPNet, and a training as a process: FOLDER STEPS."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

from planformer.data.dataset import PathProblem
from planformer.data.recipe import MapRecipe
from planformer.data.spec import DatasetSpec
from planformer.models.mpnet import MPNetConfig
from planformer.training.mpnet import train_mpnet
from planformer.training.mpnet_config import MPNetTrainConfig

SIDE = 6.0
NETWORK = MPNetConfig(channels=(4, 4, 8), grid=3, latent=8, widths=(96, 64, 32), dropout=0.2)


def door_map():
    """(120, 120) bool: two rooms, joined by a door at the top."""
    blocked = np.zeros((120, 120), bool)
    blocked[:80, 57:63] = True
    return blocked


class DoorPaths:
    """Paths from one room into the other: a `PathSource` in memory."""

    def __init__(self, count, seed=0):
        rng = np.random.default_rng(seed)
        self.spec = DatasetSpec(kinds=("forest",), maps=2, paths_per_map=count, seed=seed)
        self.recipes = (MapRecipe("forest", 0, SIDE, SIDE, 0.05),) * 2
        self._starts = rng.uniform((0.2, 0.2), (2.7, 3.5), (count, 2))
        self._goals = rng.uniform((3.3, 0.2), (5.8, 3.5), (count, 2))

    def __len__(self):
        return len(self._starts)

    def __getitem__(self, index):
        start, goal = self._starts[index], self._goals[index]
        path = np.array([start, (2.75, 4.3), (3.25, 4.3), goal])
        return PathProblem(index % 2, start, goal, path)

    def blocked_map(self, map_id):
        assert map_id in (0, 1)
        return door_map()


def config(**given):
    """Settings of a training of a second or less."""
    common = {"network": NETWORK, "threads": 1, "bfloat16": False, "maps": 1, "waypoints": 64}
    return MPNetTrainConfig(**{**common, "validate_every": 10, "learning_rate": 5e-3, **given})


if __name__ == "__main__":
    folder, steps = sys.argv[1:]
    train_mpnet(
        config(steps=int(steps), checkpoint_seconds=1e-6),
        DoorPaths(20),
        Path(folder),
        validation=DoorPaths(6, seed=1),
    )
