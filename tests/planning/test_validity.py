from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import planformer as pf
from planformer.errors import InvalidProblem
from planformer.planning import Problem, SearchLimits, search

from .conftest import DUBINS, POINT, REEDS_SHEPP, random_problem

QUICK = SearchLimits(20.0, max_vertices=3000)


@pytest.fixture(scope="module")
def point_path(open_room):
    result = search(random_problem(open_room, POINT, 5), "RRTstar", limits=QUICK, seed=1)
    assert result.solved
    return result.path


@pytest.fixture(scope="module", params=[DUBINS, REEDS_SHEPP], ids=["Dubins", "ReedsShepp"])
def car_and_path(request, open_room):
    problem = random_problem(open_room, request.param, 5)
    result = search(problem, "RRTConnect", limits=QUICK, seed=1)
    assert result.solved
    assert len(result.path) > 20
    return request.param, result.path


def moved(path, index, delta):
    copy = path.copy()
    copy[index] += delta
    return copy


def test_planned_paths_are_valid_forwards_and_a_point_s_backwards(open_room, point_path):
    assert pf.path_is_valid(open_room, POINT, point_path)
    assert pf.path_is_valid(open_room, POINT, point_path[::-1])
    assert pf.path_is_valid(open_room, POINT, point_path.tolist())
    assert pf.path_is_valid(open_room, POINT, point_path[:1])


def test_a_thicker_robot_does_not_fit_the_same_path(open_room, point_path):
    assert not pf.path_is_valid(open_room, pf.PointRobot(radius=2.0), point_path)


def test_points_through_a_wall_are_invalid(open_room):
    left, right = open_room.to_xy([(50, 30), (50, 90)])
    assert pf.path_is_valid(open_room, POINT, [left])
    assert pf.path_is_valid(open_room, POINT, [right])
    assert not pf.path_is_valid(open_room, POINT, [left, right])


def test_a_wall_one_cell_thin_is_seen_between_far_points():
    occupied = np.zeros((40, 400), bool)
    occupied[:, 200] = True
    grid = pf.OccupancyGrid(occupied, 0.05)
    ends = grid.to_xy([(20, 10), (23, 390)])
    assert not pf.path_is_valid(grid, pf.PointRobot(radius=0.0), ends)


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf, 1e300, -1e9])
def test_undefined_and_far_points_are_invalid(open_room, point_path, value):
    for column in (0, 1):
        path = point_path.copy()
        path[len(path) // 2, column] = value
        assert not pf.path_is_valid(open_room, POINT, path)


@pytest.mark.parametrize("column", [0, 1, 2])
def test_undefined_poses_are_invalid(open_room, car_and_path, column):
    robot, path = car_and_path
    assert not pf.path_is_valid(open_room, robot, moved(path, (5, column), np.nan))


def test_car_paths_are_valid(open_room, car_and_path):
    robot, path = car_and_path
    assert pf.path_is_valid(open_room, robot, path)
    turned = path + (0.0, 0.0, 2 * np.pi)
    assert pf.path_is_valid(open_room, robot, turned)


def test_a_jump_is_invalid(open_room, car_and_path):
    robot, path = car_and_path
    assert not pf.path_is_valid(open_room, robot, moved(path, len(path) // 2, (0.05, -0.02, 0.0)))


def test_turning_in_place_is_invalid(open_room, car_and_path):
    robot, path = car_and_path
    pose = path[len(path) // 2]
    turn = [*path[: len(path) // 2 + 1], pose + (0.0, 0.0, 0.01), *path[len(path) // 2 + 1 :]]
    assert not pf.path_is_valid(open_room, robot, turn)


def test_a_skid_is_invalid(open_room, car_and_path):
    robot, path = car_and_path
    assert not pf.path_is_valid(open_room, robot, path + (0.0, 0.0, 0.02))


def test_a_turn_tighter_than_the_car_s_is_invalid(open_room, car_and_path):
    robot, path = car_and_path
    wider = type(robot)(radius=robot.radius, turning_radius=robot.turning_radius * 1.02)
    assert not pf.path_is_valid(open_room, wider, path)


def test_driving_backwards_is_for_reeds_shepp_cars_only(open_room, car_and_path):
    robot, path = car_and_path
    assert pf.path_is_valid(open_room, robot, path[::-1]) == robot.reverses
    straight = np.zeros((3, 3))
    straight[:, :2] = open_room.to_xy([(20, 20), (20, 24), (20, 28)])
    straight[:, 2] = open_room.origin[2] + np.pi  # looks back
    assert pf.path_is_valid(open_room, robot, straight) == robot.reverses


def test_a_car_path_is_checked_between_its_poses(open_room):
    poses = np.zeros((2, 3))
    poses[:, :2] = open_room.to_xy([(50, 30), (50, 90)])
    poses[:, 2] = open_room.origin[2]
    assert not pf.path_is_valid(open_room, DUBINS, poses)
    poses[:, :2] = open_room.to_xy([(20, 30), (20, 90)])
    assert pf.path_is_valid(open_room, DUBINS, poses)


@pytest.mark.parametrize(
    ("robot", "path"),
    [
        (POINT, np.zeros((3, 3))),
        (POINT, np.zeros((0, 2))),
        (POINT, [0.0, 1.0]),
        (POINT, np.zeros((1, 2, 2))),
        (DUBINS, np.zeros((3, 2))),
    ],
)
def test_a_path_of_the_wrong_shape_is_an_error_that_names_the_right_one(open_room, robot, path):
    with pytest.raises(InvalidProblem, match=rf"\(N, {robot.state_dimension}\)"):
        pf.path_is_valid(open_room, robot, path)


@settings(max_examples=60)
@given(
    st.floats(-1e4, 1e4),
    st.floats(-1e4, 1e4),
    st.floats(-np.pi, np.pi) | st.just(0.0),
    st.sampled_from([0.05, 0.1, 0.25]),
    st.booleans(),
)
def test_a_straight_way_along_a_wall_is_valid_wherever_the_map_lies(x, y, yaw, resolution, upright):
    """Rounding in the world frame throws points on a grid line to either side of it."""
    occupied = np.zeros((40, 40), bool)
    occupied[:20] = True
    way = np.linspace((5.0, 20.0), (35.0, 20.0), 101)
    if upright:
        occupied, way = occupied.T, way[:, ::-1]
    grid = pf.OccupancyGrid(occupied, resolution, origin=(x, y, yaw))
    robot = pf.PointRobot(radius=0.0)
    assert pf.path_is_valid(grid, robot, grid.frame.to_world(way * resolution))
    inside = np.where(way == 20.0, 19.999, way)
    assert not pf.path_is_valid(grid, robot, grid.frame.to_world(inside * resolution))


@pytest.mark.parametrize("yaw", [0.0, -2.0])
@pytest.mark.parametrize("robot", [pf.PointRobot(radius=0.2), DUBINS], ids=["point", "car"])
def test_plans_along_the_edge_of_a_wall_s_inflation_are_not_withheld(robot, yaw):
    occupied = np.zeros((60, 200), bool)
    occupied[:20] = True
    grid = pf.OccupancyGrid(occupied, 0.05, origin=(-12.3, 4.56, yaw))
    problem = Problem(grid, robot, *ends_on_the_edge(grid, robot))
    for planner in ("RRT", "InformedRRTstar"):
        for seed in range(1, 11):
            limits = SearchLimits(20.0, max_vertices=200)
            assert search(problem, planner, limits=limits, seed=seed).solved


def ends_on_the_edge(grid, robot):
    """Start and goal on the lowest free row's lower line, or above it by no more than rounding."""
    y = (20 + round(robot.radius / grid.resolution)) * grid.resolution
    for lift in (0.0, 1e-15, 4e-15, 1.6e-14):
        local = [(1.0, y + lift, 0.0), (9.0, y + lift, 0.0)]
        states = grid.frame.to_world(local)[:, : robot.state_dimension]
        if not grid.blocked(robot.radius)[tuple(grid.to_rc(states[:, :2]).T)].any():
            return [tuple(state) for state in states]
    raise AssertionError("the edge is blocked")


@pytest.mark.parametrize("kind", [pf.DubinsCar, pf.ReedsSheppCar])
def test_arcs_much_shorter_than_a_cell_are_told_from_skids(kind):
    grid = pf.OccupancyGrid(np.zeros((20, 20), bool), 0.5)
    robot = kind(radius=0.1, turning_radius=0.05)
    problem = Problem(grid, robot, (5.0, 5.0, 0.0), (4.95, 5.0, 0.0))  # nearly a full circle
    result = search(problem, "RRTConnect", limits=QUICK, seed=1)
    assert result.solved
    assert result.length > 0.05
    turns = np.abs(np.angle(np.exp(1j * np.diff(result.path[:, 2]))))
    assert turns.max() <= np.pi / 2 + 1e-9


@pytest.mark.parametrize("path", [[(0.0, 0.0), (1.0,)], "path", [("here", "there")], None])
def test_a_path_that_is_not_of_numbers_is_an_error(open_room, path):
    with pytest.raises(InvalidProblem, match="path"):
        pf.path_is_valid(open_room, POINT, path)
