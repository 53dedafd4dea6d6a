from __future__ import annotations

import itertools

import pytest

pytest.importorskip("torch", reason="training needs PyTorch")

from planformer.errors import InvalidDataset, InvalidParameter
from planformer.training import TrainConfig
from planformer.training.optimizer import learning_rate
from planformer.training.samples import ResumableBatches


def test_published_schedule_peaks_at_the_end_of_its_warmup():
    config = TrainConfig(recipe="paper", steps=10**6, warmup_steps=3200)
    rates = [learning_rate(config, step=step, seconds=0.0) for step in range(20000)]
    assert rates.index(max(rates)) == 3199
    assert max(rates) == pytest.approx(0.5 * 256**-0.5 * 3200**-0.5)


@pytest.mark.parametrize("limit", ["steps", "seconds"])
def test_cosine_falls_from_its_peak_to_a_fiftieth(limit):
    config = TrainConfig(**{limit: 1000}, warmup_steps=10, learning_rate=1.0)
    rates = [learning_rate(config, step=i, seconds=float(i)) for i in range(1001)]
    assert max(rates) == pytest.approx(1.0, abs=0.01)
    assert rates[:10] == sorted(rates[:10])
    assert rates[10:] == sorted(rates[10:], reverse=True)
    assert rates[-1] == pytest.approx(0.02)


@pytest.mark.parametrize(
    "values",
    [
        {},
        {"steps": 0},
        {"seconds": -1.0},
        {"steps": 1, "batch_size": 0},
        {"steps": 1, "learning_rate": float("nan")},
        {"steps": 1, "recipe": "sgd"},
        {"steps": 1, "workers": -1},
        {"steps": 1, "devices": 0},
        {"steps": 1, "devices": 3, "batch_size": 32},
    ],
)
def test_refuses(values):
    with pytest.raises(InvalidParameter):
        TrainConfig(**values)


@pytest.mark.parametrize("name", ["learning_rate", "weight_decay", "positive_weight"])
def test_settings_of_the_compact_recipe_are_for_it_alone(name):
    with pytest.raises(InvalidParameter, match=f"{name} .*'paper'; got 0.5"):
        TrainConfig(recipe="paper", steps=1, **{name: 0.5})
    assert name not in TrainConfig(recipe="paper", steps=1).to_dict()
    assert TrainConfig(steps=1, **{name: 0.5}).to_dict()[name] == 0.5


def _take(count, **options):
    return list(itertools.islice(ResumableBatches(23, 5, seed=3, **options), count))


def test_batches_continue_where_they_stopped():
    whole = _take(20)
    for step in range(15):
        assert _take(5, step=step) == whole[step : step + 5]


def test_processes_share_out_each_batch():
    for whole, *shares in zip(_take(9), *(_take(9, share=(i, 3)) for i in range(3)), strict=True):
        assert sorted(key for share in shares for key in share) == sorted(whole)
        assert max(map(len, shares)) - min(map(len, shares)) <= 1


def test_an_epoch_shows_every_problem_at_most_once():
    batches = _take(8)
    for epoch in range(2):
        keys = [key for batch in batches for key in batch if key[0] == epoch]
        assert len(keys) == len(set(keys)) == 20
    assert [i for _, i in batches[0]] != [i for _, i in batches[4]]


def test_refuses_fewer_problems_than_a_batch():
    with pytest.raises(InvalidDataset):
        ResumableBatches(4, 5, seed=0)
