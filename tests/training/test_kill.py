from __future__ import annotations

import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("torch", reason="training needs PyTorch")

import torch

from planformer.models import load_checkpoint

STEPS = 150
KILLS = 2


@pytest.fixture
def start():
    """Start trainings; none outlives the test."""
    processes = []

    def run(*arguments):
        script = Path(__file__).with_name("process.py")
        command = [sys.executable, str(script), *map(str, arguments)]
        pipe = subprocess.PIPE
        processes.append(subprocess.Popen(command, stdout=pipe, stderr=pipe, text=True))
        return processes[-1]

    yield run
    for process in processes:
        process.kill()
        process.communicate()


def _finish(process):
    out, err = process.communicate(timeout=600)
    assert process.returncode == 0, err
    return out


def _weights(folder):
    _, model, stored = load_checkpoint(folder / "checkpoint.pt")
    weights = torch.cat([value.flatten().float() for value in model.state_dict().values()])
    return weights, stored["step"], stored["history"]


def _kill_after_a_checkpoint(process, checkpoint, delay):
    """Whether the process was killed before it had finished."""
    before = checkpoint.stat().st_mtime_ns if checkpoint.exists() else 0
    while process.poll() is None and not (
        checkpoint.exists() and checkpoint.stat().st_mtime_ns > before
    ):
        time.sleep(0.001)
    time.sleep(delay)
    process.kill()
    process.communicate()
    return process.returncode == -signal.SIGKILL


def test_a_training_that_is_killed_again_and_again_ends_as_one_that_is_not(tmp_path, start):
    """A checkpoint follows every step, so most kills hit one that is being written."""
    whole, killed = tmp_path / "whole", tmp_path / "killed"
    reference = start(whole, STEPS, 1)
    rng = np.random.default_rng()
    kills = [
        _kill_after_a_checkpoint(start(killed, STEPS, 1), killed / "checkpoint.pt", delay)
        for delay in rng.uniform(0.0, 0.3, KILLS)
    ]
    assert any(kills)
    assert 0 < _weights(killed)[1] < STEPS
    _finish(start(killed, STEPS, 1))
    _finish(reference)
    (ours, step, history), (expected, _, whole_history) = _weights(killed), _weights(whole)
    assert step == STEPS
    assert torch.equal(ours, expected)
    assert [{**row, "seconds": 0} for row in history] == [
        {**row, "seconds": 0} for row in whole_history
    ]
    assert sorted(path.name for path in killed.iterdir()) == ["checkpoint.pt", "log.csv"]


def test_two_devices_share_each_batch_and_learn_what_one_does(tmp_path, start):
    pytest.importorskip("lightning_fabric", reason="several devices need Lightning Fabric")
    one, two = start(tmp_path / "one", 4, 1), start(tmp_path / "two", 4, 2)
    assert _finish(one).split() == ["4"]
    assert _finish(two).split() == ["4", "4"]
    (ours, _, history), (expected, _, whole_history) = (
        _weights(tmp_path / name) for name in ("two", "one")
    )
    assert torch.allclose(ours, expected, atol=1e-5)
    assert history[-1]["train_loss"] == pytest.approx(whole_history[-1]["train_loss"], abs=1e-5)
