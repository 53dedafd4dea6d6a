"""Random planning problems on a map."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from planformer.errors import InvalidParameter
from planformer.maps.grid import OccupancyGrid
from planformer.planning.problem import Problem
from planformer.robots import Robot

_CELL_MARGIN = 0.05
_MAX_ROUNDS = 100
_PAIRS_A_ROUND = 25


def draw_problems(
    grid: OccupancyGrid,
    robot_radius: float,
    count: int,
    *,
    min_distance: float,
    max_distance: float | None = None,
    rng: np.random.Generator,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Draw solvable pairs of start and goal for a disc robot.

    Both are uniform over the largest 4-connected component of the cells that are not blocked, so
    a path always exists; pairs closer than `min_distance` or farther than `max_distance` are
    drawn again. Points are uniform inside their cell but for 5 % along its border, so that
    rounding never changes the cell.

    Args:
        grid: The map.
        robot_radius: Radius of the robot in metres.
        count: Number of pairs.
        min_distance: Least straight-line distance from start to goal in metres.
        max_distance: Greatest straight-line distance in metres; None = any.
        rng: Source of randomness.

    Returns:
        Starts and goals, each (count, 2) in metres, world frame.

    Raises:
        InvalidParameter: The map has no free cell, or hardly a pair of its points is as far apart
            as it should be.
    """
    cells = _roomy_cells(grid, robot_radius)
    rounds = _rounds(cells, grid.resolution, count, (min_distance, max_distance), rng)
    pairs = np.empty((0, 2, 2))
    for fitting in islice(rounds, _MAX_ROUNDS):
        pairs = np.concatenate([pairs, fitting])
        if len(pairs) >= count:
            world = grid.frame.to_world(pairs[:count])
            return world[:, 0], world[:, 1]
    raise _too_few(grid, len(pairs), _MAX_ROUNDS * count, (min_distance, max_distance))


def random_problems(
    grid: OccupancyGrid,
    robot: Robot,
    *,
    min_distance: float,
    max_distance: float | None = None,
    rng: np.random.Generator,
) -> Iterator[Problem]:
    """Endless random problems: points as those of `draw_problems`, a car's yaw uniform.

    A point robot's problems are all solvable. A car's often are not: a third of those in forests
    start or end with no room to turn.

    Raises:
        InvalidParameter: As `draw_problems`.
    """
    distances = (min_distance, max_distance)
    cells = _roomy_cells(grid, robot.radius)
    empty = 0
    for pairs in _rounds(cells, grid.resolution, _PAIRS_A_ROUND, distances, rng):
        empty = 0 if len(pairs) else empty + 1
        if empty == _MAX_ROUNDS:
            raise _too_few(grid, 0, _MAX_ROUNDS * _PAIRS_A_ROUND, distances)
        for pair in grid.frame.to_world(pairs):
            yaws = rng.uniform(-math.pi, math.pi, (2, robot.state_dimension - 2))
            start, goal = np.hstack([pair, yaws]).tolist()
            yield Problem(grid, robot, tuple(start), tuple(goal))


def largest_component(free: NDArray[np.bool_]) -> NDArray[np.int64]:
    """(N, 2) cells (row, column) of the largest 4-connected component of a (H, W) bool mask."""
    import cv2

    _, labels = cv2.connectedComponents(free.astype(np.uint8), connectivity=4)
    sizes = np.bincount(labels[free])
    return np.argwhere(labels == sizes.argmax()) if len(sizes) else np.empty((0, 2), np.int64)


def _roomy_cells(grid: OccupancyGrid, robot_radius: float) -> NDArray[np.int64]:
    cells = largest_component(~grid.blocked(robot_radius))
    if len(cells) == 0:
        raise InvalidParameter(f"{grid} has no free cell for a robot of radius {robot_radius} m")
    return cells


def _rounds(
    cells: NDArray[np.int64],
    resolution: float,
    count: int,
    distances: tuple[float, float | None],
    rng: np.random.Generator,
) -> Iterator[NDArray[np.float64]]:
    """Endless rounds of `count` random pairs, (N, 2, 2) of them at a distance in range."""
    least, most = distances[0], math.inf if distances[1] is None else distances[1]
    while True:
        drawn = _draw_points(cells, resolution, count, rng)
        distance = np.hypot(*(drawn[:, 0] - drawn[:, 1]).T)
        yield drawn[(distance >= least) & (distance <= most)]


def _draw_points(
    cells: NDArray[np.int64], resolution: float, count: int, rng: np.random.Generator
) -> NDArray[np.float64]:
    """(count, 2, 2) pairs of points (x, y) in metres, local frame."""
    rc = cells[rng.integers(len(cells), size=(count, 2))]
    offset = rng.uniform(_CELL_MARGIN, 1.0 - _CELL_MARGIN, rc.shape)
    return np.asarray((rc + offset)[..., ::-1] * resolution)


def _too_few(
    grid: OccupancyGrid, found: int, drawn: int, distances: tuple[float, float | None]
) -> InvalidParameter:
    least, most = distances
    rule = f"at least {least} m" if most is None else f"{least} to {most} m"
    return InvalidParameter(
        f"only {found} of {drawn} random pairs of points on {grid} are {rule} apart; "
        "choose a smaller min_distance" + ("" if most is None else " or a larger max_distance")
    )
