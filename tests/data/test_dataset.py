from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest

from planformer.data import recipe
from planformer.data.dataset import PathDataset
from planformer.errors import InvalidDataset
from planformer.maps.forest import generate_forest


def test_it_holds_every_problem_in_order(small_dataset):
    dataset = PathDataset(small_dataset)
    assert len(dataset) == 2 * 3 * 4
    assert [r.kind for r in dataset.recipes] == ["forest"] * 3 + ["maze"] * 3
    assert dataset.map_ids.tolist() == np.repeat(range(6), 4).tolist()
    assert [problem.map_id for problem in dataset] == dataset.map_ids.tolist()
    assert len({tuple(problem.start) for problem in dataset}) == len(dataset)


def test_paths_are_valid_on_their_maps_and_starts_far_from_goals(small_dataset):
    dataset = PathDataset(small_dataset)
    for problem in dataset:
        np.testing.assert_array_equal(problem.path[[0, -1]], [problem.start, problem.goal])
        assert np.hypot(*(problem.start - problem.goal)) >= 3.0
        between = np.linspace(problem.path[:-1], problem.path[1:], 2000).reshape(-1, 2)
        columns, rows = np.floor(between / 0.05).astype(int).T
        assert not dataset.blocked_map(problem.map_id)[rows, columns].any()


def test_maps_equal_the_inflated_grid_also_the_second_time(small_dataset):
    dataset = PathDataset(small_dataset)
    for map_id, made_by in enumerate(dataset.recipes):
        expected = made_by.generate().blocked(0.1)
        dataset.blocked_map(map_id)[:] = True  # a caller's copy, not the cache
        np.testing.assert_array_equal(dataset.blocked_map(map_id), expected)
        assert dataset.blocked_map(map_id).dtype == np.bool_


def test_indices_behave_as_a_sequence(small_dataset):
    dataset = PathDataset(small_dataset)
    np.testing.assert_array_equal(dataset[-1].path, dataset[len(dataset) - 1].path)
    for index in (len(dataset), -len(dataset) - 1):
        with pytest.raises(IndexError):
            dataset[index]
    with pytest.raises(ValueError, match="read-only"):
        dataset[0].path[0] = 0.0


def test_missing_and_damaged_shards_are_errors(small_dataset):
    shard = small_dataset / "forest-00001.npz"
    whole = shard.read_bytes()
    shard.write_bytes(whole[: len(whole) // 2])
    with pytest.raises(InvalidDataset, match=r"forest-00001\.npz is damaged"):
        PathDataset(small_dataset)
    shard.unlink()
    with pytest.raises(InvalidDataset, match="lacks 1 of 4 shards"):
        PathDataset(small_dataset)


@pytest.mark.parametrize("other", ["maze-00001.npz", "forest-00000.npz"])
def test_a_shard_in_the_place_of_another_is_an_error(small_dataset, other):
    (small_dataset / other).replace(small_dataset / "forest-00001.npz")
    (small_dataset / other).write_bytes((small_dataset / "maze-00000.npz").read_bytes())
    with pytest.raises(InvalidDataset, match="of another data set"):
        PathDataset(small_dataset)


def test_a_changed_generator_is_noticed(small_dataset, monkeypatch):
    def changed(seed, **size):
        return generate_forest(seed, circles=69, **size)

    monkeypatch.setitem(recipe.GENERATORS, "forest", changed)
    with pytest.raises(InvalidDataset, match="another map"):
        PathDataset(small_dataset).blocked_map(0)


def test_reading_needs_numpy_alone(small_dataset):
    program = f"""
import sys
for name in ("cv2", "scipy", "PIL", "yaml", "rich", "matplotlib", "planformer._core"):
    sys.modules[name] = None  # importing it fails
from planformer.data.dataset import PathDataset
dataset = PathDataset({str(small_dataset)!r})
assert dataset.blocked_map(dataset[0].map_id).shape == (480, 480)
"""
    subprocess.run([sys.executable, "-c", program], check=True)
