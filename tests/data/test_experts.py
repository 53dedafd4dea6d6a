from __future__ import annotations

import math

import numpy as np
import pytest

import planformer as pf
from planformer.data.experts import (
    RRTstarExpert,
    create_expert,
    expert_names,
    hybrid_astar,
    shortest_path,
)
from planformer.data.problems import draw_problems
from planformer.errors import InvalidParameter
from planformer.geometry import polyline_length
from planformer.maps.grid import OccupancyGrid
from planformer.planning import Problem, SearchLimits, search

POINT, CAR = pf.PointRobot(0.1), pf.DubinsCar(0.2, 0.549)
REVERSING_CAR = pf.ReedsSheppCar(0.2, 0.549)


@pytest.fixture
def walled():
    """A 4 m x 4 m map, turned and moved, with a wall at x = 2 m (own frame) open at its top."""
    occupied = np.zeros((80, 80), bool)
    occupied[:60, 40] = True
    return OccupancyGrid(occupied, 0.05, origin=(10.0, -5.0, 0.6))


def test_the_path_goes_round_the_wall_from_the_exact_start_to_the_exact_goal(walled):
    start, goal = walled.frame.to_world([(1.01, 1.02), (3.03, 1.04)])
    path = shortest_path(walled, 0.1, start, goal)
    assert path is not None
    np.testing.assert_array_equal(path[[0, -1]], [start, goal])
    # Taut round the robot's corners at the wall's end: rows of cells from 62 on are free there.
    corners = [(1.01, 1.02), (1.875, 3.075), (2.175, 3.075), (3.03, 1.04)]
    assert polyline_length(path) == pytest.approx(polyline_length(corners), rel=0.01)
    between = np.linspace(path[:-1], path[1:], 500).reshape(-1, 2)
    rows, columns = walled.to_rc(between).T
    assert not walled.blocked(0.1)[rows, columns].any()


def test_none_where_nothing_joins_the_points(walled):
    inside, other_side = walled.frame.to_world([(1.0, 1.0), (3.0, 1.0)])
    assert shortest_path(walled, 1.1, inside, other_side) is None
    assert shortest_path(walled, 0.1, inside, (100.0, 0.0)) is None
    assert shortest_path(walled, 0.1, (math.nan, 0.0), inside) is None
    assert shortest_path(walled, 0.1, inside, walled.frame.to_world((2.02, 1.0))) is None


@pytest.mark.parametrize("bad", [(1.0,), (1.0, 2.0, 3.0), 1.0])
def test_a_point_of_another_shape_is_an_error(walled, bad):
    with pytest.raises(InvalidParameter, match=r"\(x, y\)"):
        shortest_path(walled, 0.1, (1.0, 1.0), bad)
    with pytest.raises(InvalidParameter, match=r"\(x, y\)"):
        shortest_path(walled, 0.1, bad, (1.0, 1.0))


def problem_on(grid, robot, start, goal):
    """A problem between two states given in the map's own frame."""
    ends = grid.frame.to_world(np.array([start, goal], float))
    return Problem(grid, robot, tuple(ends[0]), tuple(ends[1]))


def path_length(path):
    """Length of a car's dense path: arcs half a cell apart are as long as their chords."""
    return polyline_length(path[:, :2])


@pytest.mark.parametrize("robot", [CAR, REVERSING_CAR], ids=["forward", "reversing"])
def test_hybrid_astar_drives_round_the_wall(walled, robot):
    problem = problem_on(walled, robot, (1.0, 1.0, 0.3), (3.0, 1.0, -1.0))
    path = hybrid_astar(problem, 200_000)
    assert path is not None
    np.testing.assert_array_equal(path[[0, -1]], [problem.start, problem.goal])
    assert pf.path_is_valid(walled, robot, path)
    on_foot = shortest_path(walled, robot.radius, problem.start[:2], problem.goal[:2])
    assert polyline_length(on_foot) < path_length(path) < 1.3 * polyline_length(on_foot)


def test_hybrid_astar_reverses_where_that_is_shorter():
    room = OccupancyGrid(np.zeros((80, 80), bool), 0.05)
    ends = (2.0, 2.0, math.pi / 2), (2.0, 1.7, math.pi / 2)
    forward, reversing = (
        hybrid_astar(problem_on(room, robot, *ends), 200_000) for robot in (CAR, REVERSING_CAR)
    )
    assert polyline_length(reversing[:, :2]) == pytest.approx(0.3, abs=1e-6)
    assert polyline_length(forward[:, :2]) > math.pi * CAR.turning_radius


def test_hybrid_astar_finds_none_where_the_car_cannot_turn(walled):
    facing_the_border = problem_on(walled, CAR, (1.0, 0.3, -math.pi / 2), (3.0, 1.0, 0.0))
    assert hybrid_astar(facing_the_border, 200_000) is None
    ahead = problem_on(walled, CAR, (1.0, 1.0, 0.3), (3.0, 1.0, -1.0))
    assert hybrid_astar(ahead, 1) is None  # given up


def test_hybrid_astar_is_no_longer_than_what_rrt_star_finds():
    """Both are near the optimum; a search that lost its way would be tens of percent longer."""
    grid, rng = pf.generate_forest(seed=3, width=12.0, height=12.0), np.random.default_rng(1)
    starts, goals = draw_problems(grid, 0.35, 5, min_distance=5.0, rng=rng)
    solved = 0
    for start, goal in zip(starts, goals, strict=True):
        yaw = math.atan2(*(goal - start)[::-1])  # where the car wants to go, more or less
        problem = Problem(grid, CAR, (*start, yaw), (*goal, yaw))
        found = search(problem, "RRTstar", limits=SearchLimits(2.0, max_vertices=600), seed=1)
        path = hybrid_astar(problem, 200_000)
        if not found.solved:
            continue
        solved += 1
        assert path is not None
        assert pf.path_is_valid(grid, CAR, path)
        assert path_length(path) < 1.03 * found.length
    assert solved >= 3


@pytest.mark.parametrize("robot", [POINT, CAR], ids=["point", "car"])
def test_every_expert_solves_from_the_exact_start_to_the_exact_goal(walled, robot):
    dimension = robot.state_dimension
    problem = problem_on(walled, robot, (1.0, 1.0, 0.3)[:dimension], (3.0, 1.0, -1.0)[:dimension])
    solvers = {name: create_expert(name, robot) for name in expert_names(robot)}
    solvers["rrtstar"] = RRTstarExpert(seconds=None, max_vertices=300)
    for expert in solvers.values():
        path = expert.solve(problem, seed=1)
        np.testing.assert_array_equal(path[[0, -1]], [problem.start, problem.goal])
        assert pf.path_is_valid(walled, robot, path)
        np.testing.assert_array_equal(path, expert.solve(problem, seed=1))


def test_rrt_star_finds_none_within_too_few_vertices(walled):
    problem = problem_on(walled, POINT, (1.0, 1.0), (3.0, 1.0))
    assert RRTstarExpert(seconds=None, max_vertices=3).solve(problem, seed=1) is None


def test_experts_are_named():
    assert expert_names(POINT)[0] == "lazy-theta"
    assert expert_names(CAR)[0] == "hybrid-astar"
    with pytest.raises(InvalidParameter, match=r"hybrid-astar.*PointRobot.*lazy-theta"):
        create_expert("hybrid-astar", POINT)
    problem = Problem(OccupancyGrid(np.zeros((40, 40), bool), 0.05), POINT, (0.5, 0.5), (1.5, 1.5))
    with pytest.raises(InvalidParameter, match="for a car"):
        hybrid_astar(problem, 10)


def test_hybrid_astar_refuses_a_turning_radius_for_which_it_has_no_memory(walled):
    sharp = pf.DubinsCar(radius=0.2, turning_radius=1e-6)
    problem = problem_on(walled, sharp, (1.0, 1.0, 0.3), (3.0, 1.0, -1.0))
    with pytest.raises(InvalidParameter, match="turning radius is too small"):
        hybrid_astar(problem, 200_000)
