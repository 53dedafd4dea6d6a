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

from planformer.errors import (
    InvalidDataset,
    InvalidParameter,
    InvalidWeights,
    TrainingDiverged,
    WeightsMismatch,
)
from planformer.models.next_ks import NextNetwork
from planformer.models.storage import load_next
from planformer.training.folder import claimed
from planformer.training.next_ks import exploration, train_next
from planformer.training.next_ks_config import NextTrainConfig
from planformer.training.next_ks_samples import _follow, make_lessons, searched_paths
from planformer.training.sources import load_example
from training import next_doors
from training.doors import SIDE, DoorPaths, door_map
from training.next_doors import NETWORK, config, train


def _weights(folder):
    model, stored = load_next(folder / "checkpoint.pt")
    return torch.cat([value.flatten() for value in model.state_dict().values()]), stored


def _train_in_vain(folder, data=None, **given):
    return train_next(
        config(**{"steps": 4, **given}),
        data or DoorPaths(20),
        folder,
        validation=DoorPaths(6, seed=1),
    )


def test_a_training_learns_and_logs(tmp_path):
    seen = []
    result = train(tmp_path, steps=40, imitation=0.9, report=seen.append)
    assert (result.step, result.finished, len(seen)) == (40, True, 40)
    first, *_, last = [p.metrics for p in seen if p.metrics is not None]
    assert result.metrics == last
    assert last["loss"] < first["loss"]
    lines = (tmp_path / "log.csv").read_text().splitlines()
    assert lines[0] == "step,seconds,learning_rate,train_loss,loss,step_error,value_error"
    assert len(lines) == 5
    assert train(tmp_path, steps=40, imitation=0.9).metrics == last


def test_a_training_resumes_exactly_in_both_stages(tmp_path):
    train(tmp_path / "whole", steps=8)

    def interrupt(progress):
        if progress.step in (2, 6):
            signal.raise_signal(signal.SIGINT)

    for stopped_at in (2, 6):
        stopped = train(tmp_path / "parts", steps=8, report=interrupt)
        assert (stopped.step, stopped.finished) == (stopped_at, False)
    assert train(tmp_path / "parts", steps=8).finished
    assert torch.equal(_weights(tmp_path / "whole")[0], _weights(tmp_path / "parts")[0])


def test_a_training_that_is_killed_ends_as_one_that_is_not(tmp_path):
    command = [sys.executable, "-m", "training.next_doors", str(tmp_path / "killed"), "30"]
    tests = str(next_doors.__file__).rsplit("/", 2)[0]
    process = subprocess.Popen(command, cwd=tests)
    try:
        while process.poll() is None and not (tmp_path / "killed" / "log.csv").exists():
            time.sleep(0.001)
    finally:
        process.kill()
    assert process.wait() == -signal.SIGKILL
    assert 0 < _weights(tmp_path / "killed")[1]["step"] < 30
    train(tmp_path / "killed", steps=30)
    train(tmp_path / "whole", steps=30)
    (ours, stored), (expected, _) = _weights(tmp_path / "killed"), _weights(tmp_path / "whole")
    assert stored["step"] == 30
    assert torch.equal(ours, expected)
    names = sorted(path.name for path in (tmp_path / "killed").iterdir())
    assert names == ["checkpoint.pt", "log.csv"]


def test_a_folder_takes_one_training_at_a_time(tmp_path):
    with claimed(tmp_path), pytest.raises(InvalidParameter, match="another process trains"):
        train(tmp_path, steps=1)


def test_seconds_end_a_training(tmp_path):
    result = train(tmp_path, seconds=0.2, imitation=1.0)
    assert result.finished
    assert result.step >= 1


def test_another_training_does_not_go_on(tmp_path):
    train(tmp_path, steps=2)
    for other in ({"states": 3}, {"seed": 1}, {"network": dataclasses.replace(NETWORK, depth=1)}):
        with pytest.raises(WeightsMismatch, match=next(iter(other))):
            train(tmp_path, steps=4, **other)
    with pytest.raises(WeightsMismatch, match="data"):
        _train_in_vain(tmp_path, DoorPaths(21))
    (tmp_path / "checkpoint.pt").write_bytes(b"damaged")
    with pytest.raises(InvalidWeights):
        train(tmp_path, steps=4)


def test_a_training_that_diverges_says_so(tmp_path):
    with pytest.raises(TrainingDiverged) as caught:
        train(tmp_path, steps=20, learning_rate=1e30, imitation=1.0)
    assert caught.value.step >= 1


def test_data_that_do_not_fit_are_refused(tmp_path):
    class CarPaths(DoorPaths):
        def __getitem__(self, index):
            problem = super().__getitem__(index)
            return problem._replace(path=np.pad(problem.path, ((0, 0), (0, 1))))

    with pytest.raises(InvalidDataset, match="car"):
        _train_in_vain(tmp_path, CarPaths(20))
    with pytest.raises(InvalidDataset, match="4"):
        _train_in_vain(tmp_path, DoorPaths(3))
    with pytest.raises(InvalidParameter, match="warp"):
        _train_in_vain(tmp_path, device="warp")


@pytest.mark.parametrize(
    "settings",
    [
        {},
        {"steps": 0},
        {"seconds": float("nan")},
        {"steps": 1, "imitation": 1.5},
        {"steps": 1, "problems": 2, "searches": 3},
        {"steps": 1, "seed": -1},
        {"steps": 1, "learning_rate": 0.0},
    ],
)
def test_settings_are_checked(settings):
    with pytest.raises(InvalidParameter):
        NextTrainConfig(**settings)


def test_exploration_falls_after_a_third():
    assert [exploration(part) for part in (0.0, 1 / 3)] == pytest.approx([1.0, 1.0])
    assert exploration(2 / 3) == pytest.approx(0.55)
    assert exploration(1.0) == pytest.approx(0.1)


def test_a_step_follows_the_path_round_its_corner_and_ends_at_the_goal():
    path = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 3.0)])
    state, step, left = _follow(path, 0.1875, 0.5)  # three quarters of the way to the corner
    np.testing.assert_allclose(state, (0.75, 0.0))
    np.testing.assert_allclose(step, (0.5, 0.5))
    assert left == pytest.approx(3.25)
    _, step, left = _follow(path, 0.975, 0.5)
    np.testing.assert_allclose(step, (0.0, 0.2), atol=1e-12)
    assert left == pytest.approx(0.1)


def test_lessons_lie_on_the_paths():
    examples = [load_example(DoorPaths(3), index) for index in range(3)]
    rng = np.random.default_rng(0)
    lessons = make_lessons(examples, [[e.path] for e in examples], 8, 50, rng)
    assert lessons.free.shape == (3, 8, 8)
    assert lessons.states.shape == lessons.steps.shape == (3, 50, 2)
    assert lessons.states.abs().max() <= 1.0
    assert lessons.steps.norm(dim=-1).max() <= 1.0 + 1e-5
    assert lessons.values.max() <= 0.0
    # The free part of the map is what the door leaves of it.
    assert float(lessons.free[0].mean()) == pytest.approx(1.0 - door_map().mean())


def test_searches_show_ways_to_the_goal():
    network = NextNetwork(NETWORK).eval()
    example = load_example(DoorPaths(1), 0)
    paths = searched_paths(network, example, exploration=0.5, samples=60, seed=1)
    assert len(paths) >= 2
    for path in paths:
        np.testing.assert_allclose(path[-1], example.goal)
        assert (path >= 0.0).all()
        assert (path <= SIDE).all()
