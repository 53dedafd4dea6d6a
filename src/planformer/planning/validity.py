"""An independent check of finished paths.

It shares no code with the planner's own checks in C++: where a planner walks a grid cell by cell,
this cuts every segment at all grid lines at once and looks up the cell of each piece.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from planformer.errors import InvalidProblem
from planformer.maps import OccupancyGrid
from planformer.robots import Robot

_NOISE = 1e-7
"""Distances below this [cells] are the rounding noise of turning into the world frame and back."""


def path_is_valid(grid: OccupancyGrid, robot: Robot, path: ArrayLike) -> bool:
    """Whether a robot can follow a path without collision and within its turning radius.

    Consecutive states are joined by straight lines, for a car by single arcs or straight lines
    that are checked as chords: pass poses about half a cell apart on arcs, as those of
    `PlanResult.path` are.

    Args:
        grid: The map.
        robot: The robot.
        path: (N, 2) points or (N, 3) poses in the world frame, N >= 1, as the robot demands.

    Returns:
        True if no cell that the path touches is blocked and every motion is possible.

    Raises:
        InvalidProblem: The path's shape does not fit the robot, or it is not of numbers.
    """
    try:
        states = np.asarray(path, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise InvalidProblem(f"a path is an array of numbers: {error}") from error
    if states.ndim != 2 or states.shape[1] != robot.state_dimension or len(states) == 0:
        raise InvalidProblem(
            f"a path of a {type(robot).__name__} has shape (N, {robot.state_dimension}), N >= 1; "
            f"got {states.shape}"
        )
    if not np.isfinite(states).all():
        return False
    if robot.motion_errors(states).any():
        return False
    points = grid.frame.to_local(states[:, :2]) / grid.resolution
    return not touched_cells_blocked(grid.blocked(robot.radius), points)


def touched_cells_blocked(blocked: NDArray[np.bool_], points: NDArray[np.float64]) -> bool:
    """Whether a polyline touches a blocked cell or leaves the grid.

    A polyline that is free when moved by rounding noise is free: a robot may drive along the edge
    of a blocked cell, where noise throws its poses to either side.

    Args:
        blocked: (H, W) bool.
        points: (N, 2) vertices (x, y) in cells, N >= 1.
    """
    return _touches(blocked, points) and _touches(blocked, points + _NOISE)


def _touches(blocked: NDArray[np.bool_], points: NDArray[np.float64]) -> bool:
    # With its ends on the grid a segment lies on it as a whole.
    if not _all_inside(blocked, points) or _any_blocked(blocked, _cells(points)):
        return True
    cells = _cells(np.clip(_pieces(points), points.min(axis=0), points.max(axis=0)))
    return _any_blocked(blocked, cells) or _slips_through(blocked, cells)


def _slips_through(blocked: NDArray[np.bool_], cells: NDArray[np.int64]) -> bool:
    """Whether consecutive (M, 2) cells meet at a corner only, between two blocked ones."""
    before, after = cells[:-1], cells[1:]
    corner = (before != after).all(axis=1)
    beside = blocked[before[:, 0], after[:, 1]] & blocked[after[:, 0], before[:, 1]]
    return bool((corner & beside).any())


def _pieces(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """(M, 2) midpoints of the pieces into which grid lines cut the segments of a polyline."""
    starts, steps = points[:-1], np.diff(points, axis=0)
    every = np.arange(len(starts))
    cuts = [_crossings(starts[:, axis], steps[:, axis]) for axis in (0, 1)]
    cuts += [(every, np.zeros(len(every))), (every, np.ones(len(every)))]
    segment = np.concatenate([owner for owner, _ in cuts])
    along = np.concatenate([parameter for _, parameter in cuts])
    order = np.lexsort((along, segment))
    segment, along = segment[order], along[order]
    lengths = np.hypot(steps[:, 0], steps[:, 1])[segment[:-1]]
    pieces = (segment[1:] == segment[:-1]) & (np.diff(along) * lengths > _NOISE)
    owner, middle = segment[:-1][pieces], 0.5 * (along[:-1] + along[1:])[pieces]
    return np.asarray(starts[owner] + middle[:, None] * steps[owner])


def _crossings(
    start: NDArray[np.float64], step: NDArray[np.float64]
) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Where segments cross whole numbers along one axis.

    Args:
        start: (S,) coordinates of the segments' starts.
        step: (S,) their extents along the axis.

    Returns:
        (M,) index of the segment and (M,) parameter in (0, 1) of each crossing.
    """
    first = np.floor(np.minimum(start, start + step)) + 1.0
    counts = np.maximum(np.ceil(np.maximum(start, start + step)) - first, 0.0).astype(np.int64)
    owner = np.repeat(np.arange(len(start)), counts)
    rank = np.arange(len(owner)) - np.repeat(np.cumsum(counts) - counts, counts)
    return owner, (first[owner] + rank - start[owner]) / step[owner]


def _cells(points: NDArray[np.float64]) -> NDArray[np.int64]:
    """(M, 2) cells (row, col) of (M, 2) points."""
    return np.floor(points[:, ::-1]).astype(np.int64)


def _all_inside(blocked: NDArray[np.bool_], points: NDArray[np.float64]) -> bool:
    return bool(((points >= 0) & (points < blocked.shape[::-1])).all())


def _any_blocked(blocked: NDArray[np.bool_], cells: NDArray[np.int64]) -> bool:
    return bool(blocked[cells[:, 0], cells[:, 1]].any())
