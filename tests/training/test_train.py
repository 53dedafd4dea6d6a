from __future__ import annotations

import csv
import os
import signal
import sys
from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("torch", reason="training needs PyTorch")

import torch

from planformer.encoding import QueryKind
from planformer.errors import InvalidDataset, InvalidParameter, MissingExtra
from planformer.models import CompactBody, MPTConfig, TransformerBody, load_checkpoint
from planformer.training import TrainConfig, train
from planformer.training.samples import encode_examples
from planformer.training.sources import load_example
from planformer.training.validation import region_quality

NETWORK = MPTConfig(CompactBody(width=24, stem=8, blocks=1, heads=1, window=6))
PAPER = MPTConfig(
    TransformerBody(width=32, layers=1, key_width=16, value_width=16, feed_forward=32),
    QueryKind.SQUARE,
)
CONFIG = TrainConfig(
    steps=8,
    batch_size=4,
    workers=0,
    threads=1,
    bfloat16=False,
    validate_every=3,
    validation_problems=6,
    warmup_steps=2,
)


def _weights(result):
    _, model, _ = load_checkpoint(result.checkpoint)
    return torch.cat([value.flatten().float() for value in model.state_dict().values()])


def _rows(folder):
    with (folder / "log.csv").open() as file:
        return list(csv.DictReader(file))


@pytest.mark.parametrize(("network", "recipe"), [(NETWORK, "compact"), (PAPER, "paper")])
def test_an_interrupted_training_ends_as_an_uninterrupted_one(
    tmp_path, straight_paths, network, recipe
):
    data, validation = straight_paths(18), straight_paths(8, seed=1)
    config = replace(CONFIG, recipe=recipe)

    def stop_at_five(progress):
        if progress.step == 5:
            os.kill(os.getpid(), signal.SIGINT)

    whole = train(network, config, data, tmp_path / "a", validation=validation)
    first = train(network, config, data, tmp_path / "b", validation=validation, report=stop_at_five)
    assert (first.step, first.finished) == (5, False)
    second = train(network, config, data, tmp_path / "b", validation=validation)
    assert whole.finished
    assert second.finished
    assert torch.equal(_weights(whole), _weights(second))
    logs = [
        [{k: v for k, v in row.items() if k != "seconds"} for row in _rows(tmp_path / run)]
        for run in "ab"
    ]
    assert logs[0] == logs[1]


def test_a_finished_training_is_left_as_it_is(tmp_path, straight_paths):
    data, validation = straight_paths(18), straight_paths(8, seed=1)
    first = train(NETWORK, CONFIG, data, tmp_path, validation=validation)
    again = train(NETWORK, CONFIG, data, tmp_path, validation=validation)
    assert again.step == first.step == 8
    assert again.metrics == first.metrics
    assert set(again.metrics) == {"all", "forest"}
    assert torch.equal(_weights(first), _weights(again))


def test_worker_processes_change_nothing(tmp_path, straight_paths):
    data, validation = straight_paths(18), straight_paths(8, seed=1)
    config = replace(CONFIG, steps=3)
    weights = [
        _weights(
            train(
                NETWORK,
                replace(config, workers=workers),
                data,
                tmp_path / str(workers),
                validation=validation,
            )
        )
        for workers in (0, 2)
    ]
    assert torch.equal(*weights)


def test_the_callers_random_state_is_left_alone(tmp_path, straight_paths):
    data = straight_paths(6)
    state = torch.get_rng_state()
    train(NETWORK, replace(CONFIG, steps=1), data, tmp_path, validation=data)
    assert torch.equal(torch.get_rng_state(), state)


def test_learns_a_few_problems_by_heart(tmp_path, straight_paths):
    data = straight_paths(4)
    config = replace(
        CONFIG, steps=150, learning_rate=5e-3, augment=False, validate_every=150, weight_decay=0.0
    )
    metrics = train(NETWORK, config, data, tmp_path, validation=data).metrics["all"]
    assert metrics["recall"] > 0.95
    assert metrics["precision"] > 0.9
    assert metrics["connected"] == 1.0


def test_learns_headings(tmp_path, car_paths):
    losses = []
    config = replace(CONFIG, steps=60, learning_rate=5e-3, validate_every=60)
    train(
        replace(NETWORK, headings=True),
        config,
        car_paths(4),
        tmp_path,
        validation=car_paths(4),
        report=lambda progress: losses.append(progress.loss),
    )
    assert np.mean(losses[-5:]) < 0.5 * np.mean(losses[:5])


@pytest.mark.parametrize("headings", [False, True])
def test_refuses_data_of_another_robot(tmp_path, straight_paths, car_paths, headings):
    own, other = (car_paths, straight_paths) if headings else (straight_paths, car_paths)
    message = "of a car; .* of a point robot" if headings else "of a point robot; .* of a car"
    network = replace(NETWORK, headings=headings)
    for data, validation in ((other(6), own(6)), (own(6), other(6))):
        with pytest.raises(InvalidDataset, match=message):
            train(network, CONFIG, data, tmp_path, validation=validation)
    assert list(tmp_path.iterdir()) == []


def test_the_papers_recipe_teaches_headings_to_the_papers_network_alone(tmp_path, car_paths):
    config, data = replace(CONFIG, recipe="paper", steps=1), car_paths(6)
    with pytest.raises(InvalidParameter, match="recipe 'compact'"):
        train(replace(NETWORK, headings=True), config, data, tmp_path, validation=data)
    assert list(tmp_path.iterdir()) == []
    paper = replace(PAPER, headings=True)
    assert train(paper, config, data, tmp_path, validation=data).finished


def test_the_log_has_a_row_for_each_validation_and_kind(tmp_path, straight_paths):
    data = straight_paths(18)
    train(NETWORK, CONFIG, data, tmp_path, validation=data)
    rows = _rows(tmp_path)
    assert [(row["step"], row["kind"]) for row in rows] == [
        (step, kind) for step in ("3", "6", "8") for kind in ("all", "forest")
    ]
    assert all(0 <= float(row["region"]) <= 1 for row in rows)


def test_the_ideal_region_is_connected_and_small(straight_paths):
    scale = NETWORK.scale
    example = load_example(straight_paths(1), 0)
    positive = encode_examples([example], scale).positive[0, 0].numpy() > 0.5
    joined, share = region_quality(example, positive, scale)
    assert joined
    assert 0 < share < 0.7
    assert region_quality(example, np.zeros_like(positive), scale) == (False, 0.0)
    assert region_quality(example, np.ones_like(positive), scale) == (True, 1.0)


def test_seconds_end_a_training(tmp_path, straight_paths):
    data = straight_paths(6)
    config = replace(CONFIG, steps=None, seconds=1e-6)
    result = train(NETWORK, config, data, tmp_path, validation=data)
    assert (result.step, result.finished) == (1, True)


def test_several_devices_need_fabric(tmp_path, straight_paths, monkeypatch):
    monkeypatch.setitem(sys.modules, "lightning_fabric", None)
    data = straight_paths(6)
    with pytest.raises(MissingExtra, match=r"lightning-fabric.*pip install 'planformer\[train\]'"):
        train(NETWORK, replace(CONFIG, devices=2), data, tmp_path, validation=data)


def test_refuses_bad_settings(tmp_path, straight_paths):
    data = straight_paths(3)
    with pytest.raises(InvalidDataset):
        train(NETWORK, CONFIG, data, tmp_path, validation=data)
    with pytest.raises(InvalidParameter):
        train(NETWORK, replace(CONFIG, device="abacus"), data, tmp_path, validation=data)
    several = replace(CONFIG, device="meta", devices=2)
    with pytest.raises(InvalidParameter, match="several devices"):
        train(NETWORK, several, data, tmp_path, validation=data)
    assert list(tmp_path.iterdir()) == []
