"""The experts whose paths are the labels."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from planformer.errors import InvalidParameter
from planformer.maps.grid import OccupancyGrid
from planformer.planning import Problem, SearchLimits, search
from planformer.robots import DubinsCar, Robot


class Expert(Protocol):
    """Solves planning problems as well as it can."""

    def solve(self, problem: Problem, seed: int) -> NDArray[np.float64] | None:
        """Find a short path.

        Args:
            problem: The problem.
            seed: 0 to 2**32 - 1; an expert that draws nothing ignores it.

        Returns:
            (N, 2) vertices or, for a car, (N, 3) poses joined by short arcs and straight lines, in
            the world frame; exactly the start first and the goal last, N >= 2. None without a path.
        """


@dataclass(frozen=True)
class LazyThetaExpert:
    """Any-angle shortest paths of a disc robot, see `shortest_path`."""

    def solve(self, problem: Problem, seed: int) -> NDArray[np.float64] | None:
        """See `Expert.solve`."""
        del seed
        return shortest_path(problem.grid, problem.robot.radius, problem.start, problem.goal)


@dataclass(frozen=True)
class HybridAstarExpert:
    """Paths of a car by Hybrid-A*: always the same, within a percent or two of the best known.

    Dolgov, Thrun, Montemerlo and Diebel, "Path Planning for Autonomous Vehicles in Unknown
    Semi-structured Environments", IJRR 29(5), 2010.

    Attributes:
        max_expansions: Poses expanded before a problem is given up; 200,000 take half a second.
    """

    max_expansions: int = 200_000

    def solve(self, problem: Problem, seed: int) -> NDArray[np.float64] | None:
        """See `Expert.solve`."""
        del seed
        return hybrid_astar(problem, self.max_expansions)


@dataclass(frozen=True)
class RRTstarExpert:
    """OMPL's RRT* on the whole map, the paper's expert.

    Attributes:
        seconds: Time for each problem; the paper's published experiments took 90.
        max_vertices: States in the tree at most, for paths that do not depend on the machine.
    """

    seconds: float | None = 90.0
    max_vertices: int | None = None

    def solve(self, problem: Problem, seed: int) -> NDArray[np.float64] | None:
        """See `Expert.solve`."""
        limits = SearchLimits(self.seconds, max_vertices=self.max_vertices)
        result = search(problem, "RRTstar", refinement=0.0, limits=limits, seed=seed)
        return result.path if result.solved else None


_POINT: dict[str, Callable[[], Expert]] = {
    "lazy-theta": LazyThetaExpert,
    "rrtstar": RRTstarExpert,
}
_CAR: dict[str, Callable[[], Expert]] = {
    "hybrid-astar": HybridAstarExpert,
    "rrtstar": RRTstarExpert,
}


def expert_names(robot: Robot) -> list[str]:
    """Names of the experts for a robot, the default first."""
    return list(_experts_for(robot))


def create_expert(name: str, robot: Robot) -> Expert:
    """An expert by name, with its usual effort.

    Raises:
        InvalidParameter: The robot has no such expert; the message lists them.
    """
    experts = _experts_for(robot)
    if name not in experts:
        raise InvalidParameter(
            f"unknown expert {name!r} for a {type(robot).__name__}; choose from {list(experts)}"
        )
    return experts[name]()


def _experts_for(robot: Robot) -> dict[str, Callable[[], Expert]]:
    return _CAR if isinstance(robot, DubinsCar) else _POINT


def shortest_path(
    grid: OccupancyGrid, robot_radius: float, start: ArrayLike, goal: ArrayLike
) -> NDArray[np.float64] | None:
    """Find the shortest path of a disc robot by any-angle grid search.

    Lazy Theta* (Nash, Koenig and Tovey, AAAI 2010) over the cells that are not blocked for the
    robot, then greedy line-of-sight shortcutting. No cell that the path touches is blocked. The
    length is within a fraction of a percent of the shortest any-angle path's in practice.

    Args:
        grid: The map.
        robot_radius: Radius of the robot in metres.
        start: (x, y) in metres, world frame.
        goal: (x, y) in metres, world frame.

    Returns:
        (N, 2) vertices in metres, world frame; exactly `start` first and `goal` last, N >= 2.
        None where either point is blocked or outside the map, or nothing joins them.

    Raises:
        InvalidParameter: The radius is negative, or a point is not (x, y).
    """
    from planformer import _core

    return _grid_path(_core.lazy_theta, grid, robot_radius, start, goal)


def astar_path(
    grid: OccupancyGrid, robot_radius: float, start: ArrayLike, goal: ArrayLike
) -> NDArray[np.float64] | None:
    """A path by A* on the 8-connected grid and greedy shortcuts; otherwise as `shortest_path`."""
    from planformer import _core

    return _grid_path(_core.astar, grid, robot_radius, start, goal)


def _grid_path(
    search: Callable[..., NDArray[np.float64]],
    grid: OccupancyGrid,
    robot_radius: float,
    start: ArrayLike,
    goal: ArrayLike,
) -> NDArray[np.float64] | None:
    ends = _ends(start, goal)
    local = grid.frame.to_local(ends)
    vertices = search(grid.blocked(robot_radius), grid.resolution, local[0], local[1])
    if len(vertices) == 0:
        return None
    path = grid.frame.to_world(vertices)
    path[[0, -1]] = ends
    return path


def _ends(start: ArrayLike, goal: ArrayLike) -> NDArray[np.float64]:
    """(2, 2) start and goal."""
    points = [np.asarray(point, dtype=np.float64) for point in (start, goal)]
    if any(point.shape != (2,) for point in points):
        raise InvalidParameter(f"start and goal must be (x, y); got {start!r} and {goal!r}")
    return np.stack(points)


def hybrid_astar(problem: Problem, max_expansions: int) -> NDArray[np.float64] | None:
    """Find a short path of a car by Hybrid-A*, see `HybridAstarExpert`.

    Args:
        problem: The problem of a car.
        max_expansions: Poses expanded before the problem is given up.

    Returns:
        (N, 3) poses in the world frame, half a cell apart on arcs; exactly the start first and the
        goal last. None where no path was found.

    Raises:
        InvalidParameter: The robot is no car, or turns so sharply that the search's cells, a
            quarter of its turning radius wide, would be far too many.
    """
    from planformer import _core

    robot = problem.robot
    if not isinstance(robot, DubinsCar):
        raise InvalidParameter(f"Hybrid-A* plans for a car; got {type(robot).__name__}")
    try:
        poses = _core.hybrid_astar(
            problem.blocked,
            problem.grid.resolution,
            robot.turning_radius,
            robot.reverses,
            problem.local_start,
            problem.local_goal,
            max_expansions,
        )
    except ValueError as error:
        raise InvalidParameter(f"{robot}: {error}") from error
    if len(poses) == 0:
        return None
    path = problem.grid.frame.to_world(poses)
    path[[0, -1]] = problem.start, problem.goal
    return path
