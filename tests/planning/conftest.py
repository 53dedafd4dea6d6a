from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import planformer as pf
from planformer.planning import Problem, planner_names

POINT = pf.PointRobot(radius=0.1)
DUBINS = pf.DubinsCar(radius=0.1, turning_radius=0.4)
REEDS_SHEPP = pf.ReedsSheppCar(radius=0.1, turning_radius=0.4)
ROBOTS = (POINT, DUBINS, REEDS_SHEPP)
EVERY_PLANNER = [
    pytest.param(robot, name, id=f"{type(robot).__name__}-{name}")
    for robot in ROBOTS
    for name in planner_names(robot)
]


def random_problem(
    grid: pf.OccupancyGrid,
    robot: Any,
    seed: int,
    *,
    apart: tuple[float, float] = (0.2, 1e9),
    clearance: float = 0.05,
) -> Problem:
    """Start and goal that are connected, `apart` metres from each other, with room round them."""
    rng = np.random.default_rng(seed)
    cells = np.argwhere(~grid.blocked(robot.radius + clearance))
    for _ in range(1000):
        start, goal = grid.to_xy(cells[rng.integers(len(cells), size=2)])
        if not apart[0] < np.hypot(*(goal - start)) < apart[1]:
            continue
        yaws = rng.uniform(-np.pi, np.pi, 2)[:, None] if robot.state_dimension == 3 else []
        ends = [(*start, *yaws[0]), (*goal, *yaws[1])] if len(yaws) else [start, goal]
        problem = Problem(grid, robot, tuple(ends[0]), tuple(ends[1]))
        if problem.is_connected:
            return problem
    raise AssertionError("no connected start and goal on this map")


@pytest.fixture(scope="session")
def open_room() -> pf.OccupancyGrid:
    """6 m x 5 m with a wall round it and a block in its middle, turned and away from the origin."""
    occupied = np.zeros((100, 120), bool)
    occupied[[0, -1]] = occupied[:, [0, -1]] = True
    occupied[40:60, 50:70] = True
    return pf.OccupancyGrid(occupied, 0.05, origin=(-3.2, 7.1, 0.6))


@pytest.fixture(scope="session")
def forest() -> pf.OccupancyGrid:
    return pf.generate_forest(seed=4, width=12.0, height=12.0)


@pytest.fixture(scope="session")
def maze() -> pf.OccupancyGrid:
    return pf.generate_maze(seed=2, width=6.675, height=6.675)
