"""Random planning problems on a map."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from planformer.errors import InvalidParameter
from planformer.maps.grid import OccupancyGrid

_CELL_MARGIN = 0.05
_MAX_ROUNDS = 100


def draw_problems(
    grid: OccupancyGrid,
    robot_radius: float,
    count: int,
    *,
    min_distance: float,
    rng: np.random.Generator,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Draw solvable pairs of start and goal for a disc robot.

    Both are uniform over the largest 4-connected component of the cells that are not blocked, so
    a path always exists; pairs closer than `min_distance` are drawn again. Points are uniform
    inside their cell but for 5 % along its border, so that rounding never changes the cell.

    Args:
        grid: The map.
        robot_radius: Radius of the robot in metres.
        count: Number of pairs.
        min_distance: Least straight-line distance from start to goal in metres.
        rng: Source of randomness.

    Returns:
        Starts and goals, each (count, 2) in metres, world frame.

    Raises:
        InvalidParameter: The map has no free cell, or hardly a pair of its points is as far apart
            as `min_distance`.
    """
    cells = largest_component(~grid.blocked(robot_radius))
    if len(cells) == 0:
        raise InvalidParameter(f"{grid} has no free cell for a robot of radius {robot_radius} m")
    pairs = np.empty((0, 2, 2))
    for _ in range(_MAX_ROUNDS):
        drawn = _draw_points(cells, grid.resolution, count, rng)
        distance = np.hypot(*(drawn[:, 0] - drawn[:, 1]).T)
        pairs = np.concatenate([pairs, drawn[distance >= min_distance]])
        if len(pairs) >= count:
            world = grid.frame.to_world(pairs[:count])
            return world[:, 0], world[:, 1]
    raise InvalidParameter(
        f"only {len(pairs)} of {_MAX_ROUNDS * count} random pairs of points on {grid} are "
        f"{min_distance} m apart; choose a smaller min_distance"
    )


def largest_component(free: NDArray[np.bool_]) -> NDArray[np.int64]:
    """(N, 2) cells (row, column) of the largest 4-connected component of a (H, W) bool mask."""
    import cv2

    _, labels = cv2.connectedComponents(free.astype(np.uint8), connectivity=4)
    sizes = np.bincount(labels[free])
    return np.argwhere(labels == sizes.argmax()) if len(sizes) else np.empty((0, 2), np.int64)


def _draw_points(
    cells: NDArray[np.int64], resolution: float, count: int, rng: np.random.Generator
) -> NDArray[np.float64]:
    """(count, 2, 2) pairs of points (x, y) in metres, local frame."""
    rc = cells[rng.integers(len(cells), size=(count, 2))]
    offset = rng.uniform(_CELL_MARGIN, 1.0 - _CELL_MARGIN, rc.shape)
    return np.asarray((rc + offset)[..., ::-1] * resolution)
