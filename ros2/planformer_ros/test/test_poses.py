from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from planformer.geometry import polyline_length, wrap_angle

from planformer_ros.poses import to_poses, yaw_of

COORDINATES = st.floats(-50.0, 50.0, width=32)
POINTS = arrays(np.float64, st.tuples(st.integers(1, 6), st.just(2)), elements=COORDINATES)
POSES = arrays(
    np.float64, st.tuples(st.integers(1, 6), st.just(3)), elements=st.floats(-3.0, 3.0, width=32)
)


@given(st.one_of(POINTS, POSES), st.floats(-10.0, 10.0), st.floats(0.05, 5.0))
def test_poses_follow_the_path_closely(states, goal_yaw, spacing):
    poses = to_poses(states, goal_yaw, spacing)
    steps = np.hypot(*np.diff(poses[:, :2], axis=0).T)
    assert (steps <= spacing + 1e-9).all()
    assert polyline_length(poses) == pytest.approx(polyline_length(states))
    np.testing.assert_array_equal(poses[-1, :2], states[-1, :2])
    for state in states:  # every state is among the poses
        assert np.abs(poses[:, :2] - state[:2]).sum(axis=1).min() < 1e-9
    assert ((poses[:, 2] > -math.pi) & (poses[:, 2] <= math.pi)).all()


@given(POINTS, st.floats(-10.0, 10.0))
def test_a_point_robot_looks_ahead_and_ends_as_asked(points, goal_yaw):
    poses = to_poses(points, goal_yaw, 0.5)
    assert poses[-1, 2] == pytest.approx(wrap_angle(goal_yaw))
    steps = np.diff(poses[:, :2], axis=0)
    moved = np.hypot(*steps.T) > 1e-6
    turned = wrap_angle(np.arctan2(steps[:, 1], steps[:, 0]) - poses[:-1, 2])[moved]
    np.testing.assert_allclose(turned, 0.0, atol=1e-4)


def test_a_car_keeps_its_headings():
    states = np.array([[0.0, 0.0, 3.0], [0.4, 0.0, -3.0]])  # through pi, not through 0
    poses = to_poses(states, 0.0, 0.1)
    assert poses[0].tolist() == [0.0, 0.0, 3.0]
    assert poses[-1].tolist() == [0.4, 0.0, -3.0]
    assert (np.abs(poses[:, 2]) >= 3.0).all()


def test_a_goal_where_the_robot_stands():
    poses = to_poses(np.array([[1.0, 2.0], [1.0, 2.0]]), 0.7, 0.1)
    np.testing.assert_allclose(poses, [[1.0, 2.0, 0.7]] * 2)


@given(st.floats(-math.pi + 1e-6, math.pi))
def test_yaw_comes_back(yaw):
    assert yaw_of(0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2)) == pytest.approx(yaw)


@pytest.mark.parametrize(
    "quaternion", [(0, 0, 0, 0), (0, 0, 0, math.nan), (0, 0, 0, 5), (math.inf, 0, 0, 1)]
)
def test_what_is_no_quaternion(quaternion):
    assert math.isnan(yaw_of(*quaternion))
