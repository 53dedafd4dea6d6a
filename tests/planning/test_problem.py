from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import planformer as pf
from planformer.errors import (
    GoalOccupied,
    GoalOutsideMap,
    InvalidProblem,
    StartOccupied,
    StartOutsideMap,
)
from planformer.planning import Problem

from .conftest import DUBINS, POINT

FREE = (25, 25)
"""A free cell of the open room; its block covers rows 40 to 59 and columns 50 to 69."""
BLOCKED = (50, 60)


def state(grid, cell, *yaw):
    return (*map(float, grid.to_xy(cell)), *yaw)


@pytest.mark.parametrize(
    ("name", "occupied", "outside"),
    [("start", StartOccupied, StartOutsideMap), ("goal", GoalOccupied, GoalOutsideMap)],
)
def test_states_are_checked(open_room, name, occupied, outside):
    def problem(bad):
        ends = {"start": state(open_room, FREE), "goal": state(open_room, FREE), name: bad}
        return Problem(open_room, POINT, **ends)

    with pytest.raises(occupied) as error:
        problem(state(open_room, BLOCKED))
    nearest = error.value.nearest_free
    row, col = open_room.to_rc(nearest)
    assert not open_room.blocked(POINT.radius)[row, col]
    free = np.argwhere(~open_room.blocked(POINT.radius))
    assert np.hypot(*(np.array([row, col]) - BLOCKED)) == np.hypot(*(free - BLOCKED).T).min()
    assert f"({nearest[0]:.3f}, {nearest[1]:.3f})" in str(error.value)

    with pytest.raises(outside, match=name):
        problem(state(open_room, (-1, 5)))
    with pytest.raises(outside, match="6 x 5 m"):
        problem((1e300, 0.0))


@pytest.mark.parametrize(
    "bad",
    [
        (),
        (1.0,),
        (1.0, 2.0, 3.0),
        (np.nan, 0.0),
        (0.0, np.inf),
        ("here", "there"),
        ("1", "2"),
        "12",
        np.zeros((2, 1)),
        (10**400, 0.0),
        ((0.0, 0.0), (0.0, 0.0)),
        None,
        4.2,
    ],
)
def test_what_is_no_state_is_an_error(open_room, bad):
    free = state(open_room, FREE)
    with pytest.raises(InvalidProblem, match="start"):
        Problem(open_room, POINT, bad, free)
    with pytest.raises(InvalidProblem, match="goal"):
        pf.plan(open_room, POINT, free, bad, guide=None)


def test_a_car_needs_its_yaw_and_the_error_says_so(open_room):
    with pytest.raises(InvalidProblem, match=r"\(x, y, yaw\) for a DubinsCar"):
        Problem(open_room, DUBINS, state(open_room, FREE), state(open_room, FREE, 0.0))
    with pytest.raises(InvalidProblem, match="finite"):
        Problem(open_room, DUBINS, state(open_room, FREE, np.nan), state(open_room, FREE, 0.0))


def test_any_sequence_of_numbers_is_a_state(open_room):
    free = state(open_room, FREE)
    for same in (list(free), np.array(free), np.array(free, np.float32).astype(float), iter(free)):
        assert len(Problem(open_room, POINT, same, free).start) == 2


def test_a_robot_that_fits_nowhere_is_told_so():
    grid = pf.OccupancyGrid(np.zeros((1, 1), bool), 0.05)
    with pytest.raises(StartOccupied, match="fits nowhere") as error:
        Problem(grid, POINT, (0.02, 0.02), (0.03, 0.03))
    assert error.value.nearest_free is None


def test_start_and_goal_may_lie_on_the_border_of_the_map():
    grid = pf.OccupancyGrid(np.zeros((10, 10), bool), 1.0)
    point = pf.PointRobot(radius=0.0)
    Problem(grid, point, (0.0, 0.0), (np.nextafter(10, 0), np.nextafter(10, 0)))
    with pytest.raises(GoalOutsideMap):
        Problem(grid, point, (0.0, 0.0), (10.0, 5.0))


@settings(max_examples=50)
@given(st.floats(-1e3, 1e3), st.floats(-1e3, 1e3), st.floats(-4, 4), st.floats(-10, 10))
def test_local_states_are_the_world_s_in_the_frame_of_the_map(x, y, yaw, heading):
    grid = pf.OccupancyGrid(np.zeros((50, 50), bool), 0.1, origin=(x, y, yaw))
    start = tuple(grid.frame.to_world((1.0, 2.0, heading)))
    problem = Problem(grid, DUBINS, start, start)
    np.testing.assert_allclose(problem.local_start[:2], (1.0, 2.0), atol=1e-9)
    assert np.cos(problem.local_start[2] - heading) == pytest.approx(1.0)
    flat = Problem(grid, POINT, start[:2], start[:2])
    np.testing.assert_array_equal(flat.local_goal[:2], problem.local_goal[:2])
    assert flat.local_goal[2] == 0.0
