from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from planformer.data.arcs import arc_ends, driven_poses
from planformer.geometry import distance_to_polyline
from planformer.robots import DubinsCar

motions = st.lists(
    st.tuples(st.sampled_from([-1.0, 0.0, 1.0]), st.floats(0.01, 4.0)), min_size=1, max_size=5
)


def drive(motions, start, radius, spacing):
    """Poses of arcs (sign, length) as a planner samples them: an independent closed form."""
    poses = [start]
    for sign, length in motions:
        x, y, yaw = poses[-1]
        count = math.ceil(length / spacing)
        for s in np.arange(1, count + 1) * (length / count):
            if sign == 0.0:
                poses.append((x + s * math.cos(yaw), y + s * math.sin(yaw), yaw))
                continue
            r = sign * radius
            turned = yaw + s / r
            poses.append(
                (
                    x + r * (math.sin(turned) - math.sin(yaw)),
                    y - r * (math.cos(turned) - math.cos(yaw)),
                    turned,
                )
            )
    path = np.array(poses)
    path[:, 2] = np.mod(path[:, 2] + math.pi, 2 * math.pi) - math.pi
    return path


@settings(max_examples=50)
@given(motions, st.floats(-3.0, 3.0), st.floats(0.3, 2.0))
def test_the_ends_stand_for_the_whole_path(motions, yaw, radius):
    path = drive(motions, (1.0, 2.0, yaw), radius, 0.025)
    ends = arc_ends(path)
    np.testing.assert_array_equal(ends[[0, -1]], path[[0, -1]])
    turning = sum(length / radius for sign, length in motions if sign)
    assert len(ends) <= 2 + 2 * len(motions) + turning / 2.0
    poses = driven_poses(ends, 0.025)
    assert not DubinsCar(0.2, radius).motion_errors(poses).any()
    assert not np.isnan(poses).any()
    for end in ends:
        assert (poses == end).all(axis=1).any()
    # Chords of 0.025 m leave arcs by 0.3 mm at most.
    assert distance_to_polyline(path[:, :2], poses[:, :2]).max() < 1e-3


def test_poses_on_arcs_are_as_close_as_asked_and_lines_stay_whole():
    ends = arc_ends(drive([(0.0, 3.0), (1.0, 1.0)], (0.0, 0.0, 0.0), 0.5, 0.01))
    np.testing.assert_allclose(ends[1], [3.0, 0.0, 0.0], atol=1e-12)
    poses = driven_poses(ends, 0.1)
    steps = np.hypot(*np.diff(poses[:, :2], axis=0).T)
    assert steps[0] == pytest.approx(3.0)
    assert len(steps) > 10
    assert steps[1:].max() <= 0.1
    np.testing.assert_allclose(poses[:, 2][1:], np.linspace(0.0, 2.0, len(poses) - 1), atol=1e-9)


def test_poses_that_repeat_do_no_harm():
    pose = np.array([1.0, 2.0, 0.5])
    path = np.array([pose, pose, pose])
    np.testing.assert_array_equal(driven_poses(arc_ends(path), 0.1)[[0, -1]], path[:2])
