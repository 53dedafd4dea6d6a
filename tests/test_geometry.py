from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from planformer.errors import InvalidParameter
from planformer.geometry import (
    Frame,
    distance_to_polyline,
    offset_to_polyline,
    polyline_length,
    wrap_angle,
)

coordinates = st.floats(-1e4, 1e4)
angles = st.floats(-100.0, 100.0)
frames = st.builds(Frame, coordinates, coordinates, angles)


@given(angles)
def test_wrapped_angle_is_equivalent_and_in_range(angle):
    wrapped = wrap_angle(angle)
    assert isinstance(wrapped, float)
    assert -math.pi < wrapped <= math.pi
    assert math.cos(wrapped) == pytest.approx(math.cos(angle), abs=1e-12)
    assert math.sin(wrapped) == pytest.approx(math.sin(angle), abs=1e-12)


@pytest.mark.parametrize(
    ("angle", "wrapped"),
    [(math.pi, math.pi), (-math.pi, math.pi), (0.1, 0.1), (3 * math.pi, math.pi)],
)
def test_wrap_angle_at_the_seam(angle, wrapped):
    assert wrap_angle(angle) == pytest.approx(wrapped, abs=1e-15)


def test_wrap_angle_takes_and_keeps_shapes():
    angle = np.linspace(-20, 20, 24).reshape(2, 3, 4)
    wrapped = wrap_angle(angle)
    assert wrapped.shape == angle.shape
    assert wrapped[1, 2, 3] == wrap_angle(float(angle[1, 2, 3]))


def test_wrap_angle_just_below_minus_pi_does_not_leave_the_interval():
    assert -math.pi < wrap_angle(float(np.nextafter(-math.pi, -4.0))) <= math.pi
    assert -math.pi < wrap_angle(float(np.nextafter(math.pi, 4.0))) <= math.pi


def test_polyline_length_ignores_yaw():
    assert polyline_length([(0, 0), (3, 4), (3, 5)]) == pytest.approx(6.0)
    assert polyline_length([(0, 0, 1.0), (3, 4, -2.0)]) == pytest.approx(5.0)
    assert polyline_length([(1, 1)]) == 0.0


def test_distance_to_polyline_of_known_points():
    polyline = [(0.0, 0.0), (2.0, 0.0), (2.0, 0.0), (2.0, 2.0)]
    points = [(1.0, 1.0), (-3.0, 4.0), (2.0, 1.3), (5.0, 6.0)]
    np.testing.assert_allclose(distance_to_polyline(points, polyline), [1.0, 5.0, 0.0, 5.0])
    np.testing.assert_allclose(distance_to_polyline([(3.0, 4.0)], [(0.0, 0.0)]), [5.0])
    assert distance_to_polyline(np.empty((0, 2)), polyline).shape == (0,)


@given(st.integers(0, 2**32))
def test_distance_to_polyline_equals_dense_sampling(seed):
    rng = np.random.default_rng(seed)
    polyline, points = rng.uniform(-5, 5, (4, 2)), rng.uniform(-6, 6, (20, 2))
    at = np.linspace(0, 1, 400)[:, None]
    dense = np.concatenate([a + at * (b - a) for a, b in itertools.pairwise(polyline)])
    expected = np.linalg.norm(points[:, None] - dense, axis=2).min(axis=1)
    distance = distance_to_polyline(points, polyline)
    assert (distance <= expected + 1e-12).all()
    np.testing.assert_allclose(distance, expected, atol=0.03)


@pytest.mark.parametrize("seed", range(5))
def test_offset_to_polyline_leads_to_it(seed):
    rng = np.random.default_rng(seed)
    polyline, points = rng.uniform(-5, 5, (4, 2)), rng.uniform(-6, 6, (20, 2))
    offset = offset_to_polyline(points, polyline)
    np.testing.assert_allclose(np.hypot(*offset.T), distance_to_polyline(points, polyline))
    np.testing.assert_allclose(distance_to_polyline(points + offset, polyline), 0.0, atol=1e-12)


def test_distance_to_an_empty_polyline_is_an_error():
    with pytest.raises(InvalidParameter, match="at least one vertex"):
        distance_to_polyline([(0, 0)], np.empty((0, 2)))


@given(frames, st.lists(st.tuples(coordinates, coordinates), min_size=1, max_size=5))
def test_frame_round_trip_of_points(frame, points):
    np.testing.assert_allclose(frame.to_world(frame.to_local(points)), points, atol=1e-9)
    np.testing.assert_allclose(frame.to_local(frame.to_world(points)), points, atol=1e-9)


@given(frames, coordinates, coordinates, angles)
def test_frame_round_trip_of_poses(frame, x, y, yaw):
    back = frame.to_world(frame.to_local((x, y, yaw)))
    np.testing.assert_allclose(back[:2], (x, y), atol=1e-9)
    assert wrap_angle(float(back[2] - yaw)) == pytest.approx(0.0, abs=1e-9)


def test_frame_of_a_known_pose():
    frame = Frame(1.0, 2.0, math.pi / 2)
    np.testing.assert_allclose(frame.to_world((1.0, 0.0)), (1.0, 3.0), atol=1e-15)
    np.testing.assert_allclose(
        frame.to_local((1.0, 3.0, 0.0)), (1.0, 0.0, -math.pi / 2), atol=1e-15
    )


@pytest.mark.parametrize("shape", [(4,), (2, 1), ()])
def test_frame_rejects_other_shapes(shape):
    with pytest.raises(InvalidParameter, match="shape"):
        Frame().to_local(np.zeros(shape))


@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_frame_rejects_non_finite_values(value):
    with pytest.raises(InvalidParameter, match="yaw"):
        Frame(0.0, 0.0, value)
