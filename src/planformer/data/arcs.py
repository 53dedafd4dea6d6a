"""Paths of cars as the ends of their arcs: what is stored, and the poses that it stands for.

A planner's path has a pose every half a cell. Between two changes of curvature it is one arc or
one straight line, which its ends determine: a tenth of the poses, and nothing is lost.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from planformer.geometry import wrap_angle
from planformer.robots.robot import turn_and_chord

_SAME_CURVATURE = 1e-5
"""Curvatures [1/m] that differ by less are one arc: no pose moves by more than 0.1 mm for it."""
_SHORTEST_CHORD = 1e-6
"""Below this length [m] a motion's curvature is rounding noise."""
_LARGEST_TURN = 2.5
"""Longest arc [rad] that is stored in one piece: its ends would be ambiguous from pi on."""


def arc_ends(path: NDArray[np.float64]) -> NDArray[np.float64]:
    """Leave out the poses inside arcs and straight lines.

    Args:
        path: (N, 3) poses in metres and rad, each joined to the next by an arc or a line, N >= 2.

    Returns:
        (M, 3) some of the poses, the first and the last among them, 2 <= M <= N.
    """
    turn, chord, _ = turn_and_chord(path)
    with np.errstate(divide="ignore", invalid="ignore"):
        curvature = np.where(chord > _SHORTEST_CHORD, 2.0 * np.sin(0.5 * turn) / chord, np.nan)
    changes = ~(np.abs(np.diff(curvature)) < _SAME_CURVATURE)  # NaN changes
    kept, turned = [0], 0.0
    for index, (change, angle, following) in enumerate(
        zip(changes, turn[:-1], turn[1:], strict=True), start=1
    ):
        turned += angle
        if change or abs(turned + following) > _LARGEST_TURN:
            kept.append(index)
            turned = 0.0
    return np.asarray(path[[*kept, len(path) - 1]])


def driven_poses(ends: NDArray[np.float64], spacing: float) -> NDArray[np.float64]:
    """The poses on the way between the ends of arcs and straight lines.

    Args:
        ends: (M, 3) poses in metres and rad, each joined to the next by an arc of less than half a
            circle or a line.
        spacing: Largest distance of poses on an arc in metres; lines are left in one piece.

    Returns:
        (N, 3) poses, `ends` exactly among them.
    """
    turn, chord, direction = turn_and_chord(ends)
    pieces = [ends[:1]]
    for (start, end), angle, length, heading in zip(
        pairwise(ends), turn, chord, direction, strict=True
    ):
        count = _pieces(angle, length, spacing)
        along = np.arange(1, count)[:, None] / count
        pieces += [_on_arc(start, angle, length, heading, along), end[None]]
    return np.concatenate(pieces)


def _pieces(turn: float, chord: float, spacing: float) -> int:
    """Into how many arcs of at most `spacing` an arc is cut."""
    if abs(turn) <= _SAME_CURVATURE * chord:  # also where neither changes
        return 1
    length = chord * 0.5 * turn / np.sin(0.5 * turn)
    return max(1, int(np.ceil(length / spacing)))


def _on_arc(
    start: NDArray[np.float64],
    turn: float,
    chord: float,
    direction: float,
    along: NDArray[np.float64],
) -> NDArray[np.float64]:
    """(K, 3) poses at (K, 1) shares of an arc's length."""
    if len(along) == 0:
        return np.empty((0, 3))
    # The chord from the start to a share of an arc turns with half of the share.
    length = chord * np.sin(0.5 * turn * along) / np.sin(0.5 * turn)
    heading = direction - 0.5 * turn * (1.0 - along)
    yaw = wrap_angle(start[2] + turn * along)
    return np.hstack(
        [start[0] + length * np.cos(heading), start[1] + length * np.sin(heading), yaw]
    )
