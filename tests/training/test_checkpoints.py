"""What a training goes on from, starts from and learns from, and what it refuses."""

from __future__ import annotations

from dataclasses import replace

import pytest

pytest.importorskip("torch", reason="training needs PyTorch")

import torch

from planformer.encoding import QueryKind
from planformer.errors import InvalidParameter, InvalidWeights, TrainingDiverged, WeightsMismatch
from planformer.models import (
    CompactBody,
    MPTConfig,
    TransformerBody,
    create_model,
    load_checkpoint,
    save_checkpoint,
)
from planformer.training import TrainConfig, train
from planformer.training.folder import claimed
from planformer.training.sources import JoinedPaths

NETWORK = MPTConfig(CompactBody(width=24, stem=8, blocks=1, heads=1, window=6))
PAPER = MPTConfig(
    TransformerBody(width=32, layers=1, key_width=16, value_width=16, feed_forward=32),
    QueryKind.SQUARE,
)
CONFIG = TrainConfig(
    steps=2,
    batch_size=4,
    workers=0,
    threads=1,
    bfloat16=False,
    validation_problems=4,
    warmup_steps=1,
)


@pytest.fixture
def run(tmp_path, straight_paths):
    """Train in a folder; the checkpoint of the last run is `run.file`."""

    def start(folder="run", *, network=NETWORK, seed=0, **changes):
        config, data = replace(CONFIG, **changes), straight_paths(8, seed)
        return train(network, config, data, tmp_path / folder, validation=straight_paths(4, 9))

    start.file = tmp_path / "run" / "checkpoint.pt"
    return start


def _weights(path):
    return load_checkpoint(path)[1].state_dict()


def _equal(first, second):
    return all(torch.equal(first[name], second[name]) for name in first)


def test_more_steps_or_time_continue_a_training(run):
    run()
    assert run(steps=4).step == 4
    assert run(steps=5, seconds=60.0, threads=None, validate_every=3, workers=1).step == 5


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"network": PAPER}, "another network: .*architecture"),
        ({"network": replace(NETWORK, query="markers")}, "another network: query 'wavefront'"),
        ({"seed": 1}, "other data: seed 0; asked for seed 1.*initial"),
        ({"batch_size": 2}, "other settings: batch_size 4; asked for batch_size 2.*initial"),
        ({"recipe": "paper"}, "other settings: recipe"),
        ({"learning_rate": 1e-4}, "other settings: learning_rate"),
        ({"augment": False}, "other settings: augment"),
    ],
)
def test_refuses_to_go_on_as_another_training(run, changes, message):
    run()
    before = run.file.read_bytes()
    with pytest.raises(WeightsMismatch, match=message):
        run(steps=4, **changes)
    assert run.file.read_bytes() == before


def test_one_data_set_and_several_are_other_data(run, tmp_path, straight_paths):
    run()
    alone, joined = straight_paths(8), JoinedPaths([straight_paths(8)])
    with pytest.raises(WeightsMismatch, match=r"other data: kinds .*; asked for parts "):
        train(NETWORK, CONFIG, joined, tmp_path / "run", validation=alone)
    train(NETWORK, CONFIG, joined, tmp_path / "joined", validation=alone)
    with pytest.raises(WeightsMismatch, match=r"other data: parts .*; asked for kinds "):
        train(NETWORK, CONFIG, alone, tmp_path / "joined", validation=alone)


@pytest.mark.parametrize("share", [0.0, 0.1, 0.5, 0.99])
def test_refuses_a_checkpoint_cut_short(run, share):
    run()
    content = run.file.read_bytes()
    run.file.write_bytes(content[: int(share * len(content))])
    with pytest.raises(InvalidWeights, match=r"checkpoint\.pt"):
        run(steps=4)


def test_refuses_weights_without_a_training(run):
    run.file.parent.mkdir()
    save_checkpoint(run.file, NETWORK, create_model(NETWORK))
    with pytest.raises(InvalidWeights, match="no checkpoint of a training"):
        run()


@pytest.mark.parametrize(
    ("recipe", "advice"), [("compact", "smaller learning rate"), ("paper", "more warm-up steps")]
)
def test_a_loss_that_is_no_number_ends_a_training_and_keeps_its_checkpoint(run, recipe, advice):
    run(recipe=recipe)
    network, model, stored = load_checkpoint(run.file)
    next(model.parameters()).data[0] = float("nan")
    save_checkpoint(run.file, network, model, **stored)
    before = run.file.read_bytes()
    message = rf"after 2 steps.*checkpoint\.pt holds.*{advice}"
    with pytest.raises(TrainingDiverged, match=message) as caught:
        run(recipe=recipe, steps=4)
    assert caught.value.step == 2
    assert caught.value.learning_rate > 0
    assert run.file.read_bytes() == before


def test_a_learning_rate_without_measure_is_noticed(run):
    with pytest.raises(TrainingDiverged, match="no checkpoint yet") as caught:
        run(steps=20, learning_rate=1e30)
    assert caught.value.step >= 1
    assert not run.file.exists()


def test_a_new_training_starts_from_initial_weights(run):
    weights = _weights(run().checkpoint)
    tuned = run("tuned", initial=str(run.file), seed=1, learning_rate=1e-12, weight_decay=0.0)
    assert all(
        torch.allclose(w, weights[k], atol=1e-9) for k, w in _weights(tuned.checkpoint).items()
    )
    fresh = run("fresh", seed=1, learning_rate=1e-12, weight_decay=0.0)
    assert not _equal(_weights(fresh.checkpoint), weights)


def test_a_training_that_goes_on_does_not_start_again(run):
    run("whole", steps=4)
    run("first", steps=2, learning_rate=1e-5)
    initial = str(run.file.parents[1] / "first" / "checkpoint.pt")
    part = run("part", steps=1, initial=initial)
    again = run("part", steps=3, initial=initial)
    assert (part.step, again.step) == (1, 3)
    whole = run("whole2", steps=3, initial=initial)
    assert _equal(_weights(again.checkpoint), _weights(whole.checkpoint))


def test_refuses_initial_weights_of_another_network(run):
    run()
    for file, network in ((run.file, PAPER), (run.file.with_name("none.pt"), NETWORK)):
        with pytest.raises(InvalidWeights, match=file.name):
            run("tuned", network=network, initial=str(file))


def test_a_pupil_comes_closer_to_its_teacher(run, straight_paths):
    """With labels and a teacher that contradict each other, the pupil ends in between."""
    teacher = create_model(NETWORK)
    for parameter in teacher.parameters():
        parameter.data.zero_()
    teacher.head.bias.data.fill_(4.0)
    file = run.file.with_name("teacher.pt")
    save_checkpoint(file, NETWORK, teacher)
    settings = {"steps": 30, "learning_rate": 5e-3, "positive_weight": 1.0}
    probabilities = []
    for folder, path in (("alone", None), ("taught", str(file))):
        _, model, _ = load_checkpoint(run(folder, teacher=path, **settings).checkpoint)
        with torch.no_grad():
            pixels = torch.zeros(1, 1, 120, 120)
            logits = model.eval()(pixels, torch.zeros(1, 6, 24, 24)).logits
        probabilities.append(float(logits.sigmoid().mean()))
    assert probabilities[1] > probabilities[0] + 0.1


def test_refuses_a_teacher_that_sees_another_input(run):
    run()
    with pytest.raises(WeightsMismatch, match=r"another input: .*query 'wavefront'"):
        run("pupil", network=replace(NETWORK, query="markers"), teacher=str(run.file))


def test_a_folder_takes_one_training_at_a_time(run):
    with (
        claimed(run.file.parent),
        pytest.raises(InvalidParameter, match="another process trains"),
    ):
        run()


def test_a_folder_that_cannot_be_made_is_told(run, tmp_path):
    (tmp_path / "file").touch()
    with pytest.raises(InvalidParameter, match="cannot be made"):
        run("file/run")
