"""From the states of a plan to poses that a controller can follow."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from planformer.geometry import wrap_angle


def to_poses(states: NDArray[np.float64], goal_yaw: float, spacing: float) -> NDArray[np.float64]:
    """Poses along a path, close to each other.

    Args:
        states: (N, 2) points or (N, 3) poses in metres and rad, N >= 1; consecutive ones are joined
            by straight lines, or by arcs whose poses are close to each other already.
        goal_yaw: Heading in rad that a path of points ends with; on the way it looks ahead.
        spacing: Longest way between neighbouring poses in metres.

    Returns:
        (M, 3) float64 poses, M >= N.
    """
    poses = states if states.shape[1] == 3 else _with_headings(states, goal_yaw)
    steps = np.diff(poses, axis=0)
    steps[:, 2] = wrap_angle(steps[:, 2])
    counts = np.maximum(np.ceil(np.hypot(steps[:, 0], steps[:, 1]) / spacing), 1).astype(np.int64)
    segment = np.repeat(np.arange(len(steps)), counts)
    rank = np.arange(len(segment)) - np.repeat(np.cumsum(counts) - counts, counts)
    share = rank / counts[segment]
    between = poses[segment] + share[:, None] * steps[segment]
    if states.shape[1] == 2:  # a point robot turns where it changes its direction
        between[:, 2] = poses[segment, 2]
    between[:, 2] = wrap_angle(between[:, 2])
    return np.vstack((between, [*poses[-1, :2], wrap_angle(float(poses[-1, 2]))]))


def yaw_of(x: float, y: float, z: float, w: float) -> float:
    """Heading in rad of a quaternion, NaN of one that is none."""
    if not abs(x * x + y * y + z * z + w * w - 1.0) < 0.01:  # also NaN
        return math.nan
    return math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))


def _with_headings(points: NDArray[np.float64], goal_yaw: float) -> NDArray[np.float64]:
    steps = np.diff(points, axis=0)
    headings = np.arctan2(steps[:, 1], steps[:, 0])
    headings[~steps.any(axis=1)] = goal_yaw  # a step of no length has no direction
    return np.column_stack((points, np.append(headings, goal_yaw)))
