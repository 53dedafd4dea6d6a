from __future__ import annotations

import numpy as np
import pytest

from planformer.data.problems import draw_problems, largest_component
from planformer.errors import InvalidParameter
from planformer.maps.grid import OccupancyGrid
from planformer.maps.maze import generate_maze


def draw(grid, count=200, min_distance=1.0, seed=0):
    return draw_problems(
        grid, 0.1, count, min_distance=min_distance, rng=np.random.default_rng(seed)
    )


def test_points_are_free_and_far_enough_apart():
    occupied = generate_maze(1, width=8.0, height=8.0).occupied
    grid = OccupancyGrid(occupied, 0.05, origin=(-3.0, 2.0, 0.7))
    starts, goals = draw(grid)
    assert starts.shape == goals.shape == (200, 2)
    for points in (starts, goals):
        rows, columns = grid.to_rc(points).T
        assert not grid.blocked(0.1)[rows, columns].any()
    assert np.hypot(*(starts - goals).T).min() >= 1.0


def test_points_are_uniform_over_the_largest_component():
    occupied = np.ones((40, 40), bool)
    occupied[2:38, 2:30] = False
    occupied[2:38, 32:38] = False
    grid = OccupancyGrid(occupied, 1.0)
    starts, goals = draw_problems(grid, 0.0, 4000, min_distance=0.0, rng=np.random.default_rng(1))
    for points in (starts, goals):
        assert points.min() >= 2.0
        assert points[:, 0].max() <= 30.0
        counts, _, _ = np.histogram2d(*points.T, bins=4, range=[[2, 30], [2, 38]])
        # 16 boxes of equal area: chi-square with 15 degrees of freedom, p = 1e-5.
        assert ((counts - 250) ** 2 / 250).sum() < 50.5
    assert len(np.unique(starts % 1.0)) > 4000  # not at the cells' centres


def test_the_seed_decides():
    grid = generate_maze(1, width=8.0, height=8.0)
    np.testing.assert_array_equal(draw(grid, seed=3), draw(grid, seed=3))
    assert not np.array_equal(draw(grid, seed=3), draw(grid, seed=4))


def test_components_join_by_sides_only():
    free = np.array([[1, 1, 0], [0, 0, 1], [0, 0, 1], [0, 0, 1]], bool)
    assert largest_component(free).tolist() == [[1, 2], [2, 2], [3, 2]]
    assert largest_component(np.zeros((2, 2), bool)).shape == (0, 2)


def test_an_impossible_map_or_distance_is_an_error():
    with pytest.raises(InvalidParameter, match="no free cell"):
        draw(OccupancyGrid(np.ones((20, 20), bool), 0.05))
    with pytest.raises(InvalidParameter, match="choose a smaller min_distance"):
        draw(OccupancyGrid(np.zeros((20, 20), bool), 0.05), min_distance=1.5)
