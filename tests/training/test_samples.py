from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("torch", reason="training needs PyTorch")

import torch

from planformer.encoding import NetworkScale, QueryKind
from planformer.errors import InvalidDataset
from planformer.models import CompactBody, MPTConfig, Proposal
from planformer.training import TrainConfig, train, validate
from planformer.training.augmentation import Example
from planformer.training.samples import encode_examples
from planformer.training.sources import JoinedPaths, open_paths

SCALES = [
    NetworkScale(query=QueryKind.SQUARE, query_stride=1, anchor_offset=4),
    NetworkScale(query=QueryKind.MARKERS),
    NetworkScale(),
]


def _example(height, width, resolution=0.05):
    blocked = np.zeros((height, width), bool)
    blocked[: height // 2, width // 3] = True
    states = np.array([[0.5, 0.5], [width, height]]) * [[1.0, 1.0], [resolution, resolution]]
    states[1] -= 0.5
    return Example(blocked, resolution, states[0], states[1], states)


@pytest.mark.parametrize("scale", SCALES)
def test_a_padded_problem_is_the_problem_on_a_map_with_a_blocked_margin(scale):
    small, large = _example(50, 90), _example(130, 70)
    batch = encode_examples([small, large], scale)
    framed = np.ones((140, 100), bool)
    framed[:50, :90] = small.blocked
    alone = encode_examples([replace(small, blocked=framed)], scale)
    for ours, expected in zip((batch.map, batch.query), (alone.map, alone.query), strict=True):
        assert torch.equal(ours[0], expected[0])
    assert torch.equal(batch.positive[0], alone.positive[0] * batch.inside[0])


def test_inside_is_what_a_network_is_asked_about():
    batch = encode_examples([_example(50, 90), _example(130, 70)], NetworkScale())
    assert batch.map.shape == (2, 1, 140, 100)
    assert batch.inside.shape == batch.positive.shape == (2, 1, 7, 5)
    for inside, rows, cols in zip(batch.inside[:, 0], (3, 7), (5, 4), strict=True):
        assert inside[:rows, :cols].all()
        assert inside.sum() == rows * cols


class _Wider:
    """The problems of a source on maps that go on to the right, of a kind of their own."""

    def __init__(self, source):
        self._source, self.spec = source, source.spec
        self.recipes = tuple(replace(r, kind="maze", width=r.width + 3.0) for r in source.recipes)

    def __len__(self):
        return len(self._source)

    def __getitem__(self, index):
        return self._source[index]

    def blocked_map(self, map_id):
        return np.pad(self._source.blocked_map(map_id), ((0, 0), (0, 60)))


@pytest.fixture
def two_sizes(straight_paths):
    return JoinedPaths([straight_paths(3), _Wider(straight_paths(3, seed=1))])


def test_joined_data_sets_follow_one_another(straight_paths, two_sizes):
    first, second = straight_paths(3), straight_paths(3, seed=1)
    assert len(two_sizes) == 6
    for index in range(6):
        problem = (first, second)[index // 3][index % 3]
        assert np.array_equal(two_sizes[index].path, problem.path)
        assert two_sizes[index].map_id == index // 3
        assert two_sizes.blocked_map(index // 3).shape == (120, 120 + 60 * (index // 3))
    for index in (-1, 6):
        with pytest.raises(IndexError):
            two_sizes[index]


def test_a_folder_is_a_data_set_or_holds_some(tmp_path):
    with pytest.raises(InvalidDataset, match="holds none"):
        open_paths(tmp_path)
    generate = pytest.importorskip("planformer.data.generate").generate_dataset
    for name, seed in (("b", 1), ("a", 0)):
        generate(tmp_path / name, kinds=["forest"], maps=1, paths_per_map=2, seed=seed, workers=1)
    joined = open_paths(tmp_path)
    assert [part.seed for part in joined.spec.parts] == [0, 1]
    assert np.array_equal(joined[3].path, open_paths(tmp_path / "b")[1].path)


def test_maps_of_several_sizes_are_trained_on_together(tmp_path, two_sizes):
    network = MPTConfig(CompactBody(width=24, stem=8, blocks=1, heads=1, window=6))
    config = TrainConfig(steps=3, batch_size=4, workers=0, threads=1, validation_problems=6)
    result = train(network, config, two_sizes, tmp_path, validation=two_sizes)
    assert {kind: values["problems"] for kind, values in result.metrics.items()} == {
        "all": 6,
        "forest": 3,
        "maze": 3,
    }


def test_metrics_do_not_depend_on_the_company_in_a_batch(two_sizes):
    """A network that selects every anchor: its region is the whole map, whatever the padding."""

    class Everywhere(torch.nn.Linear):
        def forward(self, occupancy, query):
            shape = (len(occupancy), 1, *(side // 20 for side in occupancy.shape[2:]))
            return Proposal(torch.full(shape, 5.0), None)

    metrics = [
        validate(
            Everywhere(1, 1),
            two_sizes,
            NetworkScale(),
            TrainConfig(steps=1, batch_size=size, validation_problems=6),
        )
        for size in (1, 6)
    ]
    for kind, alone in metrics[0].items():
        together = metrics[1][kind]
        assert alone["region"] == together["region"] == 1.0
        assert {**alone, "loss": 0.0} == {**together, "loss": 0.0}
