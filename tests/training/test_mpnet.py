from __future__ import annotations

import dataclasses
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

pytest.importorskip("torch", reason="training needs PyTorch")

import torch

from planformer.data.dataset import PathProblem
from planformer.errors import InvalidDataset, InvalidParameter, TrainingDiverged, WeightsMismatch
from planformer.models.storage import load_mpnet, save_planner
from planformer.training.folder import claimed
from planformer.training.mpnet import train_mpnet
from planformer.training.mpnet_config import MPNetOptimizer
from planformer.training.mpnet_samples import WaypointSamples, _next_waypoint
from training import doors
from training.doors import NETWORK, DoorPaths, config, door_map

DATA, VALIDATION = DoorPaths(20), DoorPaths(6, seed=1)


def _train(folder, **given):
    report = given.pop("report", None)
    return train_mpnet(config(**given), DATA, folder, validation=VALIDATION, report=report)


def _weights(folder):
    model, stored = load_mpnet(folder / "checkpoint.pt")
    return torch.cat([value.flatten() for value in model.state_dict().values()]), stored


@pytest.mark.parametrize("optimizer", list(MPNetOptimizer))
def test_a_training_learns_and_logs(tmp_path, optimizer):
    seen = []
    settings = {"steps": 150, "optimizer": optimizer, "augment": False, "validate_every": 30}
    result = _train(tmp_path, **settings, report=seen.append)
    assert (result.step, result.finished, len(seen)) == (150, True, 150)
    first, *_, last = [p.validation_loss for p in seen if p.validation_loss is not None]
    assert result.validation_loss == last < first
    lines = (tmp_path / "log.csv").read_text().splitlines()
    assert lines[0] == "step,seconds,learning_rate,train_loss,validation_loss"
    assert len(lines) == 6


def test_a_training_resumes_exactly(tmp_path):
    _train(tmp_path / "whole", steps=12)

    def interrupt(progress):
        if progress.step == 5:
            signal.raise_signal(signal.SIGINT)

    stopped = _train(tmp_path / "parts", steps=12, report=interrupt)
    assert (stopped.step, stopped.finished, stopped.validation_loss) == (5, False, None)
    assert _train(tmp_path / "parts", steps=12).finished
    assert torch.equal(_weights(tmp_path / "whole")[0], _weights(tmp_path / "parts")[0])


def test_a_training_that_is_killed_ends_as_one_that_is_not(tmp_path):
    command = [sys.executable, doors.__file__, str(tmp_path / "killed"), "150"]
    process = subprocess.Popen(command)
    try:
        while process.poll() is None and not (tmp_path / "killed" / "log.csv").exists():
            time.sleep(0.001)
    finally:
        process.kill()
    assert process.wait() == -signal.SIGKILL
    assert 0 < _weights(tmp_path / "killed")[1]["step"] < 150
    _train(tmp_path / "killed", steps=150)
    _train(tmp_path / "whole", steps=150)
    (ours, stored), (expected, _) = _weights(tmp_path / "killed"), _weights(tmp_path / "whole")
    assert stored["step"] == 150
    assert torch.equal(ours, expected)
    names = sorted(path.name for path in (tmp_path / "killed").iterdir())
    assert names == ["checkpoint.pt", "log.csv"]


def test_a_folder_takes_one_training_at_a_time(tmp_path):
    with claimed(tmp_path), pytest.raises(InvalidParameter, match="another process trains"):
        _train(tmp_path, steps=1)


def test_seconds_end_a_training(tmp_path):
    result = _train(tmp_path, seconds=0.05)
    assert result.finished
    assert _weights(tmp_path)[1]["seconds"] >= 0.05


def test_a_diverged_training_says_so(tmp_path):
    with pytest.raises(TrainingDiverged) as caught:
        _train(tmp_path, steps=50, learning_rate=1e30)
    assert caught.value.step >= 1


def test_a_gradient_without_measure_ends_a_training_and_keeps_its_checkpoint(tmp_path):
    """The network predicts zeros, a finite loss; its last hidden layer's gradient overflows."""
    _train(tmp_path, steps=1)
    file = tmp_path / "checkpoint.pt"
    model, stored = load_mpnet(file)
    with torch.no_grad():
        model.hidden[-2].bias.fill_(1e35)
        for layer, weight in ((model.hidden[-1], 0.0), (model.output, 1e10)):
            layer.weight.fill_(weight)
            layer.bias.zero_()
    save_planner(file, model, **stored)
    before = file.read_bytes()
    with pytest.raises(TrainingDiverged, match=r"loss 0\.\d+ or its gradient .* after 1 steps"):
        _train(tmp_path, steps=2)
    assert file.read_bytes() == before


@pytest.mark.parametrize("change", [{"seed": 1}, {"waypoints": 3}, {"optimizer": "adagrad"}])
def test_another_training_is_refused(tmp_path, change):
    _train(tmp_path, steps=1)
    with pytest.raises(WeightsMismatch, match=next(iter(change))):
        _train(tmp_path, steps=2, **change)


def test_another_network_or_data_is_refused(tmp_path):
    _train(tmp_path, steps=1)
    with pytest.raises(WeightsMismatch, match="network"):
        _train(tmp_path, steps=2, network=dataclasses.replace(NETWORK, grid=2))
    with pytest.raises(WeightsMismatch, match="data"):
        train_mpnet(config(steps=2), DoorPaths(30), tmp_path, validation=VALIDATION)


def test_the_waypoint_is_the_first_corner_between_two_points_of_the_path():
    path = np.array([(0.0, 0.0), (3.0, 0.0), (3.0, 4.0), (5.0, 4.0)])
    rng = np.random.default_rng(0)
    corners = set()
    for _ in range(200):
        point, later, corner = _next_waypoint(path, *rng.random(2))
        corners.add(tuple(corner))
        if tuple(corner) == (3.0, 0.0):
            assert point[1] == 0
            assert later[0] >= 3
        else:
            assert point[0] == 3
            assert later[1] == 4
    assert corners == {(3.0, 0.0), (3.0, 4.0)}


def test_flipped_and_turned_samples_still_fit_their_maps():
    samples = WaypointSamples(DATA, NETWORK.scale)
    rng = np.random.default_rng(0)
    seen = set()
    for _ in range(30):
        batch = samples.draw([0], 20, rng, augment=True)
        pixels = batch.maps[0][0, 0].numpy()
        seen.add(pixels.tobytes())
        for states in (batch.current, batch.target):
            columns, rows = ((states.numpy() + 1) / 2 * 120).astype(int).T
            assert not pixels[rows, columns].any()
    assert len(seen) == 4  # the door's map has a symmetry of its own
    assert door_map().tobytes() in seen


def test_paths_without_corners_teach_nothing():
    straight = DoorPaths(3)
    straight.__class__ = type(
        "Straight",
        (DoorPaths,),
        {"__getitem__": lambda self, i: PathProblem(0, *np.ones((2, 2)), np.ones((2, 2)))},
    )
    with pytest.raises(InvalidDataset, match="straight"):
        WaypointSamples(straight, NETWORK.scale)


def test_a_cars_paths_are_refused():
    poses = np.zeros((3, 3))
    car = type(
        "Car",
        (DoorPaths,),
        {"__getitem__": lambda self, i: PathProblem(0, poses[0], poses[2], poses)},
    )
    with pytest.raises(InvalidDataset, match="point robot"):
        WaypointSamples(car(2), NETWORK.scale)


@pytest.mark.parametrize(
    "change",
    [
        {"steps": None, "seconds": None},
        {"steps": 0},
        {"maps": 0},
        {"learning_rate": float("inf")},
        {"optimizer": "sgd"},
        {"seed": -1},
    ],
)
def test_impossible_settings(change):
    with pytest.raises(InvalidParameter):
        config(**{"steps": 1, **change})
