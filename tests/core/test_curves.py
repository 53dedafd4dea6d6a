"""Shortest curves of a car in the compiled core: Dubins and Reeds-Shepp."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from planformer import _core

PI = math.pi
ORIGIN = (0.0, 0.0, 0.0)
SIDEWAYS_U = math.acos((4**2 + 2**2 - 2.5**2) / (2 * 4 * 2))

# Multiples of round steps meet the borders between words often, and exactly but for rounding.
COORDINATE = st.integers(-80, 80).map(lambda k: k / 4)
YAW = st.integers(-16, 16).map(lambda k: k * PI / 16)
GRID_POSES = st.tuples(COORDINATE, COORDINATE, YAW)
ANY_POSES = st.tuples(st.floats(-1e3, 1e3), st.floats(-1e3, 1e3), st.floats(-PI, PI))
RADII = st.sampled_from([0.25, 0.55, 1.0, 4.0])
REVERSE = st.booleans()


def length(start, goal, *, radius=1.0, reverse=False):
    return _core.curve_lengths(np.array([start]), np.array([goal]), radius, reverse)[0]


def poses(start, goal, *, radius=1.0, reverse=False, step=0.1):
    return _core.curve_poses(np.array(start), np.array(goal), radius, reverse, step)


def wrap(angle):
    return np.remainder(np.asarray(angle) + PI, 2 * PI) - PI


@pytest.mark.parametrize(
    ("goal", "forward", "both_ways"),
    [
        (ORIGIN, 0.0, 0.0),
        ((5.0, 0.0, 0.0), 5.0, 5.0),
        ((-5.0, 0.0, 0.0), 2 * PI + 5.0, 5.0),
        ((1.0, 1.0, PI / 2), PI / 2, PI / 2),
        ((1.0, -1.0, -PI / 2), PI / 2, PI / 2),
        ((-1.0, 1.0, -PI / 2), None, PI / 2),
        ((0.0, 2.0, PI), PI, PI),
        ((2.0, 2.0, 0.0), PI, PI),
        ((2.0, 5.0, 0.0), PI + 3.0, PI + 3.0),
        # On the spot: three turns, of 60, 300 and 60 degrees or of 60 degrees each with two cusps.
        ((0.0, 0.0, PI), 7 * PI / 3, PI),
        # Sideways, four turns a, u, u, a with two cusps: the circles' centres form a triangle with
        # sides 4 and 2 that enclose u and a third one of 2.5, the distance of first and last.
        ((0.0, 0.5, 0.0), None, 2 * (SIDEWAYS_U + math.asin(2 * math.sin(SIDEWAYS_U) / 2.5))),
    ],
)
def test_golden_lengths(goal, forward, both_ways):
    if forward is not None:
        assert length(ORIGIN, goal) == pytest.approx(forward, abs=1e-12)
    assert length(ORIGIN, goal, reverse=True) == pytest.approx(both_ways, abs=1e-12)


@given(start=ANY_POSES | GRID_POSES, goal=ANY_POSES | GRID_POSES, radius=RADII, reverse=REVERSE)
def test_curve_joins_start_and_goal(start, goal, radius, reverse):
    path = poses(start, goal, radius=radius, reverse=reverse)
    assert np.isfinite(path).all()
    for end, pose in ((path[0], start), (path[-1], goal)):
        assert np.abs(end[:2] - pose[:2]).max() < 1e-6
        assert abs(wrap(end[2] - pose[2])) < 1e-6


@given(start=GRID_POSES, goal=GRID_POSES, radius=RADII, reverse=REVERSE)
def test_curve_is_made_of_arcs_and_straight_lines(start, goal, radius, reverse):
    step = 0.1 * radius
    path = poses(start, goal, radius=radius, reverse=reverse, step=step)
    chord = np.diff(path[:, :2], axis=0)
    turn = wrap(np.diff(path[:, 2]))
    middle = path[:-1, 2] + turn / 2
    along = chord[:, 0] * np.cos(middle) + chord[:, 1] * np.sin(middle)
    across = chord[:, 1] * np.cos(middle) - chord[:, 0] * np.sin(middle)
    arc = np.abs(turn) > 1e-9
    assert np.abs(across).max(initial=0.0) < 1e-6
    np.testing.assert_allclose(np.abs(along)[arc], 2 * radius * np.sin(np.abs(turn[arc]) / 2))
    assert (np.abs(turn) * radius <= step * (1 + 1e-9)).all()
    assert reverse or (along >= -1e-9).all()
    driven = np.where(arc, np.abs(turn) * radius, np.abs(along)).sum()
    assert driven == pytest.approx(length(start, goal, radius=radius, reverse=reverse), abs=1e-6)


@given(start=GRID_POSES, via=GRID_POSES, goal=GRID_POSES, radius=RADII, reverse=REVERSE)
def test_no_detour_is_shorter(start, via, goal, radius, reverse):
    direct = length(start, goal, radius=radius, reverse=reverse)
    first = length(start, via, radius=radius, reverse=reverse)
    second = length(via, goal, radius=radius, reverse=reverse)
    assert math.dist(start[:2], goal[:2]) <= direct + 1e-9
    assert direct <= first + second + 1e-5


@given(start=GRID_POSES, goal=GRID_POSES, radius=RADII, reverse=REVERSE)
def test_every_pose_of_a_curve_is_on_the_way(start, goal, radius, reverse):
    whole = length(start, goal, radius=radius, reverse=reverse)
    path = poses(start, goal, radius=radius, reverse=reverse, step=radius)
    starts = np.broadcast_to(start, path.shape).copy()
    goals = np.broadcast_to(goal, path.shape).copy()
    before = _core.curve_lengths(starts, path, radius, reverse)
    after = _core.curve_lengths(path, goals, radius, reverse)
    np.testing.assert_allclose(before + after, whole, atol=2e-5)


@given(start=GRID_POSES, goal=GRID_POSES, radius=RADII, reverse=REVERSE)
def test_mirrored_and_reversed_curves_are_as_long(start, goal, radius, reverse):
    expected = length(start, goal, radius=radius, reverse=reverse)

    def mirrored(pose):
        return (pose[0], -pose[1], -pose[2])

    def turned(pose):
        return (pose[0], pose[1], pose[2] + PI)

    mirror = length(mirrored(start), mirrored(goal), radius=radius, reverse=reverse)
    back = length(turned(goal), turned(start), radius=radius, reverse=reverse)
    assert mirror == pytest.approx(expected, abs=1e-5)
    assert back == pytest.approx(expected, abs=1e-5)


@given(
    start=GRID_POSES,
    goal=GRID_POSES,
    frame=ANY_POSES,
    radius=RADII,
    scale=st.floats(0.1, 10.0),
    reverse=REVERSE,
)
def test_lengths_follow_rigid_motion_and_scale(start, goal, frame, radius, scale, reverse):
    cos, sin = math.cos(frame[2]), math.sin(frame[2])

    def moved(pose):
        x, y = scale * pose[0], scale * pose[1]
        return (frame[0] + cos * x - sin * y, frame[1] + sin * x + cos * y, frame[2] + pose[2])

    there = length(moved(start), moved(goal), radius=scale * radius, reverse=reverse)
    here = length(start, goal, radius=radius, reverse=reverse)
    assert there / scale == pytest.approx(here, abs=2e-4 * radius)


@given(start=GRID_POSES, goal=GRID_POSES, radius=RADII)
def test_reversing_never_costs(start, goal, radius):
    both_ways = length(start, goal, radius=radius, reverse=True)
    assert both_ways <= length(start, goal, radius=radius) + 1e-9
    assert both_ways <= length(goal, start, radius=radius) + 1e-9
    assert both_ways == pytest.approx(length(goal, start, radius=radius, reverse=True), abs=1e-12)


@given(start=GRID_POSES, goal=GRID_POSES, radius=RADII)
def test_the_way_back_in_reverse_is_the_same_curve(start, goal, radius):
    there = poses(start, goal, radius=radius, reverse=True)
    back = poses(goal, start, radius=radius, reverse=True)
    difference = there - back[::-1]
    difference[:, 2] = wrap(difference[:, 2])
    np.testing.assert_allclose(difference, 0.0, atol=1e-9)


@pytest.mark.parametrize("reverse", [False, True])
def test_poses_that_are_not_finite_are_infinitely_far(reverse):
    assert length((math.nan, 0.0, 0.0), ORIGIN, reverse=reverse) == math.inf
    assert length(ORIGIN, (0.0, 0.0, math.inf), reverse=reverse) == math.inf
    with pytest.raises(ValueError, match="finite"):
        poses(ORIGIN, (0.0, math.nan, 0.0), reverse=reverse)


@pytest.mark.parametrize("value", [0.0, -1.0, math.nan, math.inf])
def test_radius_and_step_must_be_positive(value):
    with pytest.raises(ValueError, match="turning_radius"):
        length(ORIGIN, ORIGIN, radius=value)
    with pytest.raises(ValueError, match="step"):
        poses(ORIGIN, ORIGIN, step=value)


def test_arrays_must_pair_up():
    none = np.empty((0, 3))
    assert _core.curve_lengths(none, none, 1.0, False).shape == (0,)
    with pytest.raises(ValueError, match="differ"):
        _core.curve_lengths(np.zeros((2, 3)), np.zeros((3, 3)), 1.0, False)
    with pytest.raises(TypeError):
        _core.curve_lengths(np.zeros((2, 2)), np.zeros((2, 2)), 1.0, False)
