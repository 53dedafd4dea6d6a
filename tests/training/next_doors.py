"""A small training of NEXT for the tests, also as a process: FOLDER STEPS."""

from __future__ import annotations

import sys
from pathlib import Path

from planformer.models.next_ks import NextConfig
from planformer.training.next_ks import train_next
from planformer.training.next_ks_config import NextTrainConfig
from training.doors import DoorPaths

NETWORK = NextConfig(side=8, depth=2, features=8, iterations=6)


def config(**given):
    """Settings of a training of seconds."""
    common = {"network": NETWORK, "threads": 1, "bfloat16": False, "problems": 4, "samples": 20}
    return NextTrainConfig(**{**common, "validate_every": 10, "learning_rate": 3e-3, **given})


def train(folder, **given):
    report = given.pop("report", None)
    return train_next(
        config(**given), DoorPaths(20), folder, validation=DoorPaths(6, seed=1), report=report
    )


if __name__ == "__main__":
    folder, steps = sys.argv[1:]
    train(Path(folder), steps=int(steps), checkpoint_seconds=1e-6)
