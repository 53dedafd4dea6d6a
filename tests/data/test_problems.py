from __future__ import annotations

from itertools import islice

import numpy as np
import pytest

from planformer.data.problems import draw_problems, largest_component, random_problems
from planformer.errors import InvalidParameter
from planformer.maps.grid import OccupancyGrid
from planformer.maps.maze import generate_maze
from planformer.robots import DubinsCar, PointRobot


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


def random(grid, robot, *, seed=0, count=200, max_distance=4.0):
    rng = np.random.default_rng(seed)
    problems = random_problems(grid, robot, min_distance=1.0, max_distance=max_distance, rng=rng)
    return list(islice(problems, count))


def test_problems_of_a_car_have_all_headings_and_a_distance_in_range():
    occupied = generate_maze(1, width=8.0, height=8.0).occupied
    grid = OccupancyGrid(occupied, 0.05, origin=(-3.0, 2.0, 0.7))
    problems = random(grid, DubinsCar(0.2, 0.5))
    states = np.array([(problem.start, problem.goal) for problem in problems])
    distance = np.hypot(*(states[:, 0] - states[:, 1])[:, :2].T)
    assert distance.min() >= 1.0
    assert distance.max() <= 4.0
    counts, _ = np.histogram(states[..., 2], bins=8, range=(-np.pi, np.pi))
    # Chi-square with 7 degrees of freedom, p = 1e-5; all headings are in the range.
    assert counts.sum() == 400
    assert ((counts - 50) ** 2 / 50).sum() < 35.0


def test_problems_follow_the_seed_and_the_robot():
    grid = generate_maze(1, width=8.0, height=8.0)
    point, again = (random(grid, PointRobot(0.1), seed=3, count=60) for _ in range(2))
    assert [(p.start, p.goal) for p in point] == [(p.start, p.goal) for p in again]
    assert len({p.start for p in point}) == 60
    assert {len(p.start) for p in point} == {2}


def test_components_join_by_sides_only():
    free = np.array([[1, 1, 0], [0, 0, 1], [0, 0, 1], [0, 0, 1]], bool)
    assert largest_component(free).tolist() == [[1, 2], [2, 2], [3, 2]]
    assert largest_component(np.zeros((2, 2), bool)).shape == (0, 2)


def test_an_impossible_map_or_distance_is_an_error():
    with pytest.raises(InvalidParameter, match="no free cell"):
        draw(OccupancyGrid(np.ones((20, 20), bool), 0.05))
    with pytest.raises(InvalidParameter, match="choose a smaller min_distance"):
        draw(OccupancyGrid(np.zeros((20, 20), bool), 0.05), min_distance=1.5)
    with pytest.raises(InvalidParameter, match=r"are 1\.0 to 1\.0001 m apart"):
        random(OccupancyGrid(np.zeros((20, 20), bool), 0.05), PointRobot(), max_distance=1.0001)
