from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import planformer as pf
from planformer import _core
from planformer.errors import InvalidRobot

CARS = (pf.DubinsCar, pf.ReedsSheppCar)
YAW = st.floats(-math.pi, math.pi)
CURVATURE = st.floats(-1.0, 1.0)


def drive(pose, curvature, steps):
    """Poses along an arc of the unit circle's curvature times `curvature`, signed steps [m]."""
    x, y, yaw = pose
    along = np.concatenate(([0.0], np.cumsum(steps)))
    turn = curvature * along
    chord = along * np.sinc(turn / (2 * np.pi))
    return np.column_stack(
        (x + chord * np.cos(yaw + turn / 2), y + chord * np.sin(yaw + turn / 2), yaw + turn)
    )


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, -0.1])
@pytest.mark.parametrize("robot", [pf.PointRobot, *CARS])
def test_impossible_dimensions_are_errors_that_name_them(robot, value):
    for field in dataclasses.fields(robot):
        with pytest.raises(InvalidRobot, match=f"{field.name} must be finite"):
            robot(**{field.name: value})


@pytest.mark.parametrize("robot", CARS)
def test_only_the_radius_may_be_zero(robot):
    for field in dataclasses.fields(robot):
        if field.name == "radius":
            assert robot(radius=0).radius == 0.0
        else:
            with pytest.raises(InvalidRobot, match="> 0"):
                robot(**{field.name: 0.0})


def test_robots_are_values():
    assert pf.PointRobot(0.2) == pf.PointRobot(radius=np.float32(0.2).astype(float).round(1))
    assert pf.DubinsCar() != pf.ReedsSheppCar()
    assert len({pf.DubinsCar(), pf.DubinsCar(), pf.ReedsSheppCar()}) == 2
    with pytest.raises(dataclasses.FrozenInstanceError):
        pf.PointRobot().radius = 1.0
    assert isinstance(pf.PointRobot(radius=1).radius, float)


def test_the_paper_s_car():
    car = pf.DubinsCar(radius=0.2, turning_radius=0.3 / math.tan(0.5), wheelbase=0.3)
    assert car.max_steering == pytest.approx(0.5)
    assert not car.reverses
    assert pf.ReedsSheppCar.reverses


def test_a_point_moves_anywhere():
    path = np.random.default_rng(0).normal(size=(20, 2))
    assert not pf.PointRobot().motion_errors(path).any()
    assert pf.PointRobot().motion_errors(path[:1]).shape == (0,)


@settings(max_examples=200)
@given(st.floats(-100, 100), st.floats(-100, 100), YAW, CURVATURE, st.booleans())
def test_arcs_within_the_turning_radius_are_driven(x, y, yaw, curvature, back):
    steps = np.full(12, -0.05 if back else 0.05)
    path = drive((x, y, yaw), curvature, steps)
    assert not pf.ReedsSheppCar(turning_radius=1.0).motion_errors(path).any()
    assert pf.DubinsCar(turning_radius=1.0).motion_errors(path).all() == back
    assert pf.DubinsCar(turning_radius=1.0).motion_errors(path).any() == back


@settings(max_examples=200)
@given(YAW, st.floats(1.02, 5.0), st.sampled_from([-1, 1]), st.sampled_from([-1, 1]))
def test_tighter_arcs_are_not(yaw, curvature, side, direction):
    path = drive((3.0, 4.0, yaw), side * curvature, np.full(8, direction * 0.1))
    for car in CARS:
        assert car(turning_radius=1.0).motion_errors(path).all()


@settings(max_examples=200)
@given(YAW, CURVATURE, st.floats(0.01, math.pi - 0.01), st.sampled_from([-1, 1]))
def test_skids_are_not(yaw, curvature, slip, side):
    path = drive((0.0, 0.0, yaw), curvature, np.full(8, 0.1))
    path[:, 2] += side * slip
    for car in CARS:
        assert car(turning_radius=1.0).motion_errors(path).all()


@settings(max_examples=300)
@given(*[st.floats(-3, 3), st.floats(-3, 3), YAW] * 2, st.booleans())
def test_the_core_s_curves_are_driven(x0, y0, yaw0, x1, y1, yaw1, reverse):
    start, goal = np.array([x0, y0, yaw0]), np.array([x1, y1, yaw1])
    poses = _core.curve_poses(start, goal, 0.5, reverse, 0.02)
    robot = (pf.ReedsSheppCar if reverse else pf.DubinsCar)(turning_radius=0.5)
    assert not robot.motion_errors(poses).any()
