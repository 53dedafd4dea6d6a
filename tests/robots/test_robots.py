from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import planformer as pf
from planformer import _core
from planformer.errors import InvalidRobot

ANGLES = st.floats(-math.pi, math.pi)
LENGTHS = st.floats(-5.0, 5.0)


@pytest.mark.parametrize("value", [-0.1, float("nan"), float("inf")])
@pytest.mark.parametrize("robot", [pf.PointRobot, pf.DubinsCar, pf.ReedsSheppCar])
def test_a_radius_is_finite_and_not_negative(robot, value):
    with pytest.raises(InvalidRobot, match=r"radius must be finite and >= 0"):
        robot(radius=value)


@pytest.mark.parametrize("value", [0.0, -0.5, float("nan"), float("inf")])
@pytest.mark.parametrize("name", ["turning_radius", "wheelbase", "max_speed"])
def test_the_dimensions_of_a_car_are_positive(name, value):
    with pytest.raises(InvalidRobot, match=name):
        pf.DubinsCar(**{name: value})


def test_a_true_point_is_a_robot():
    assert pf.PointRobot(radius=0).radius == 0.0


def test_the_papers_car_steers_half_a_radian():
    assert pf.DubinsCar(turning_radius=0.549, wheelbase=0.3).max_steering == pytest.approx(
        0.5, abs=1e-3
    )


@given(x=LENGTHS, y=LENGTHS, start=ANGLES, goal=ANGLES, radius=st.floats(0.2, 2.0))
@pytest.mark.parametrize("kind", [pf.DubinsCar, pf.ReedsSheppCar])
def test_a_car_can_drive_its_own_curves(kind, x, y, start, goal, radius):
    car = kind(turning_radius=radius)
    poses = _core.curve_poses(
        np.array([0.0, 0.0, start]), np.array([x, y, goal]), radius, car.reverses, 0.025
    )
    assert not car.motion_errors(poses).any()


def _arc(radius: float, turn: float, count: int = 50) -> np.ndarray:
    angles = np.linspace(0.0, turn, count)
    return np.column_stack(
        (radius * np.sin(np.abs(angles)), np.sign(turn) * radius * (1 - np.cos(angles)), angles)
    )


@pytest.mark.parametrize("turn", [1.0, -1.0])
def test_a_turn_tighter_than_the_robots_is_an_error(turn):
    car = pf.DubinsCar(turning_radius=0.55)
    assert not car.motion_errors(_arc(0.55, turn)).any()
    assert car.motion_errors(_arc(0.54, turn)).all()


def test_a_car_does_not_skid_or_turn_on_the_spot():
    car = pf.DubinsCar()
    poses = np.array([[0, 0, 0], [0, 0.1, 0], [0, 0.1, 0.3], [0.1, 0.1 + 0.1 * math.tan(0.3), 0.3]])
    np.testing.assert_array_equal(car.motion_errors(poses), [True, True, False])


def test_only_a_reeds_shepp_car_reverses():
    backwards = np.array([[0, 0, 0], [-0.5, 0, 0]], float)
    assert pf.DubinsCar().motion_errors(backwards).all()
    assert not pf.ReedsSheppCar().motion_errors(backwards).any()


def test_a_point_robot_moves_as_it_likes():
    path = np.random.default_rng(0).normal(size=(20, 2))
    errors = pf.PointRobot().motion_errors(path)
    assert errors.shape == (19,)
    assert not errors.any()
