from __future__ import annotations

import math
import shutil
import subprocess
import sys

import numpy as np
import pytest

from planformer.data import recipe
from planformer.data.dataset import PathDataset
from planformer.data.generate import generate_dataset
from planformer.errors import InvalidDataset
from planformer.maps import load_map
from planformer.maps.forest import generate_forest
from planformer.planning import path_is_valid
from planformer.robots import DubinsCar, PointRobot


def test_it_holds_every_problem_in_order(small_dataset):
    dataset = PathDataset(small_dataset)
    assert len(dataset) == 2 * 3 * 4
    assert [r.kind for r in dataset.recipes] == ["forest"] * 3 + ["maze"] * 3
    assert dataset.map_ids.tolist() == np.repeat(range(6), 4).tolist()
    assert [problem.map_id for problem in dataset] == dataset.map_ids.tolist()
    assert len({tuple(problem.start) for problem in dataset}) == len(dataset)
    assert dataset.unsolved.tolist() == [0] * 6  # the exact expert solves what has a solution


def test_paths_are_valid_on_their_maps_and_starts_far_from_goals(small_dataset):
    dataset = PathDataset(small_dataset)
    for problem in dataset:
        np.testing.assert_array_equal(problem.path[[0, -1]], [problem.start, problem.goal])
        assert np.hypot(*(problem.start - problem.goal)) >= 3.0
        grid = dataset.recipes[problem.map_id].grid()
        assert path_is_valid(grid, PointRobot(0.1), problem.path)


def test_paths_of_cars_are_poses_that_the_car_can_drive(car_dataset):
    dataset = PathDataset(car_dataset)
    robot = DubinsCar(0.2, 0.3 / math.tan(0.5))
    assert dataset.spec.make_robot() == robot
    assert len(dataset) == 3 * 2
    for problem in dataset:
        assert problem.start.shape == problem.goal.shape == (3,)
        np.testing.assert_array_equal(problem.path[[0, -1]], [problem.start, problem.goal])
        assert 4.0 <= np.hypot(*(problem.start - problem.goal)[:2]) <= 8.0
        assert path_is_valid(dataset.recipes[problem.map_id].grid(), robot, problem.path)
        turns = np.abs(np.diff(np.unwrap(problem.path[:, 2])))
        assert turns.max() <= 0.025 / robot.turning_radius + 1e-6


def test_a_cars_paths_take_few_stored_poses(car_dataset):
    dataset = PathDataset(car_dataset)
    dense = sum(len(problem.path) for problem in dataset)
    stored = len(dataset._vertices)
    assert stored < dense / 4


def test_maps_equal_the_inflated_grid_also_the_second_time(small_dataset):
    dataset = PathDataset(small_dataset)
    for map_id, made_by in enumerate(dataset.recipes):
        expected = made_by.grid().blocked(0.1)
        assert made_by.shape == expected.shape == (180, 240)
        dataset.blocked_map(map_id)[:] = True  # a caller's copy, not the cache
        np.testing.assert_array_equal(dataset.blocked_map(map_id), expected)
        assert dataset.blocked_map(map_id).dtype == np.bool_


def test_maps_of_ones_own_keep_their_sizes(own_maps, tmp_path):
    generate_dataset(
        tmp_path / "set", maps_from=own_maps, paths_per_map=2, workers=1, show_progress=False
    )
    names = ["bench.map", "floors/rooms.npy", "office.yaml", "picture.png"]
    expected = [load_map(own_maps / name) for name in names]
    shutil.rmtree(own_maps)  # the data set needs them no more
    dataset = PathDataset(tmp_path / "set")
    assert [own.kind for own in dataset.recipes] == ["user"] * 4
    assert [own.resolution for own in dataset.recipes] == [0.05, 0.05, 0.1, 0.05]
    for map_id, grid in enumerate(expected):
        np.testing.assert_array_equal(dataset.blocked_map(map_id), grid.blocked(0.1))
    for problem in dataset:  # in the frame of the map's lower-left corner
        grid = dataset.recipes[problem.map_id].grid()
        assert path_is_valid(grid, PointRobot(0.1), problem.path)


def test_indices_behave_as_a_sequence(small_dataset):
    dataset = PathDataset(small_dataset)
    np.testing.assert_array_equal(dataset[-1].path, dataset[len(dataset) - 1].path)
    for index in (len(dataset), -len(dataset) - 1):
        with pytest.raises(IndexError):
            dataset[index]
    with pytest.raises(ValueError, match="read-only"):
        dataset[0].path[0] = 0.0


def test_missing_and_damaged_shards_are_errors(small_dataset):
    shard = small_dataset / "forest-00001.parquet"
    whole = shard.read_bytes()
    shard.write_bytes(whole[: len(whole) // 2])
    with pytest.raises(InvalidDataset, match=r"forest-00001\.parquet is damaged"):
        PathDataset(small_dataset)
    shard.unlink()
    with pytest.raises(InvalidDataset, match="lacks 1 of 4 shards"):
        PathDataset(small_dataset)


@pytest.mark.parametrize("other", ["maze-00001.parquet", "forest-00000.parquet"])
def test_a_shard_in_the_place_of_another_is_an_error(small_dataset, other):
    (small_dataset / other).replace(small_dataset / "forest-00001.parquet")
    (small_dataset / other).write_bytes((small_dataset / "maze-00000.parquet").read_bytes())
    with pytest.raises(InvalidDataset, match="of another data set"):
        PathDataset(small_dataset)


@pytest.mark.parametrize(
    ("change", "what"),
    [
        ({"paths_per_map": 5}, "paths a map"),
        ({"robot_radius": 0.2}, "robot"),
        ({"width": 13.0}, "maps"),
        ({"seed": 99}, "maps"),
    ],
)
def test_a_shard_made_with_other_settings_is_an_error(
    small_dataset, small_settings, tmp_path, change, what
):
    generate_dataset(tmp_path / "other", workers=1, **{**small_settings, **change})
    shard = "maze-00001.parquet"
    (small_dataset / shard).write_bytes((tmp_path / "other" / shard).read_bytes())
    with pytest.raises(InvalidDataset, match=rf"maze-00001.*of another data set: .*{what}"):
        PathDataset(small_dataset)


def test_a_changed_generator_is_noticed(small_dataset, monkeypatch):
    def changed(seed, **size):
        return generate_forest(seed, circles=3, **size)

    monkeypatch.setitem(recipe.GENERATORS, "forest", changed)
    with pytest.raises(InvalidDataset, match="another map"):
        PathDataset(small_dataset).blocked_map(0)


def test_reading_needs_numpy_and_pyarrow_alone(car_dataset):
    program = f"""
import sys
for name in ("cv2", "scipy", "PIL", "yaml", "rich", "matplotlib", "ray", "planformer._core"):
    sys.modules[name] = None  # importing it fails
from planformer.data.dataset import PathDataset
dataset = PathDataset({str(car_dataset)!r})
assert dataset.blocked_map(dataset[0].map_id).shape == (180, 240)
"""
    subprocess.run([sys.executable, "-c", program], check=True)


def test_without_pyarrow_the_error_says_how_to_install_it():
    program = """
import sys
sys.modules["pyarrow"] = None
try:
    import planformer.data.dataset
except ImportError as error:
    assert "pip install 'planformer[train]'" in str(error)
else:
    raise SystemExit(1)
"""
    subprocess.run([sys.executable, "-c", program], check=True)
