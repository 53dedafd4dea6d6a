"""A training as a process of its own, to be killed or to start others: FOLDER STEPS DEVICES."""

from __future__ import annotations

import gc
import sys
from pathlib import Path

import torch
from torch.nn.parallel import DistributedDataParallel

from conftest import StraightPaths
from planformer.models import CompactBody, MPTConfig
from planformer.training import TrainConfig, train

NETWORK = MPTConfig(CompactBody(width=24, stem=8, blocks=1, heads=1, window=6), offsets=True)


def run(folder, steps, devices=1):
    config = TrainConfig(
        steps=steps,
        devices=devices,
        batch_size=4,
        workers=0,
        threads=1,
        bfloat16=False,
        validate_every=10,
        validation_problems=2,
        warmup_steps=2,
        checkpoint_seconds=1e-6,
    )
    validation = StraightPaths(2, seed=1)
    return train(NETWORK, config, StraightPaths(18), Path(folder), validation=validation)


def destroy_group_without_models(destroy=torch.distributed.destroy_process_group):
    """A shared model that is left would take the group with it, and now and then hang."""
    left = [one for one in gc.get_objects() if type(one) is DistributedDataParallel]
    assert not left, "a shared model outlives the process group"
    destroy()


if __name__ == "__main__":
    torch.distributed.destroy_process_group = destroy_group_without_models
    folder, steps, devices = sys.argv[1:]
    done = run(folder, int(steps), int(devices))
    sys.stdout.write(f"{done.step}\n")  # at once: the lines of two processes must not mix
