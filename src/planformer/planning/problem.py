"""A planning problem: a map, a robot, a start and a goal, checked once."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from planformer.errors import (
    GoalOccupied,
    GoalOutsideMap,
    InvalidProblem,
    StartOccupied,
    StartOutsideMap,
)
from planformer.maps import OccupancyGrid
from planformer.robots import Robot

State = tuple[float, ...]


@dataclass(frozen=True)
class Problem:
    """A valid planning problem.

    Attributes:
        grid: The map.
        robot: The robot.
        start: (x, y) or (x, y, yaw) in the world frame, metres and rad, as the robot demands.
        goal: As the start.

    Raises:
        InvalidProblem: A state has the wrong number of values or is not finite.
        StartOutsideMap: The start is not on the map. Likewise GoalOutsideMap.
        StartOccupied: The robot would be in collision at the start; the message and the error's
            `nearest_free` name the closest free point. Likewise GoalOccupied.
    """

    grid: OccupancyGrid
    robot: Robot
    start: State
    goal: State
    blocked: NDArray[np.bool_] = field(init=False, repr=False, compare=False)
    """(H, W) bool: the map inflated by the robot's radius."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "blocked", self.grid.blocked(self.robot.radius))
        for name in ("start", "goal"):
            state = _checked_state(getattr(self, name), name, self.robot)
            object.__setattr__(self, name, state)
            _check_on_map(state, name, self.grid)
            _check_free(state, name, self)

    @cached_property
    def is_connected(self) -> bool:
        """Whether start and goal lie in one part of the map, so that a disc can get there."""
        components = self.grid.components(self.robot.radius)
        (r0, c0), (r1, c1) = self.grid.to_rc([self.start[:2], self.goal[:2]])
        return bool(components[r0, c0] == components[r1, c1])

    @cached_property
    def local_start(self) -> NDArray[np.float64]:
        """(3,) start pose in the map's own frame; the yaw of a point robot is 0."""
        return self._local(self.start)

    @cached_property
    def local_goal(self) -> NDArray[np.float64]:
        """(3,) goal pose in the map's own frame; the yaw of a point robot is 0."""
        return self._local(self.goal)

    def _local(self, state: State) -> NDArray[np.float64]:
        pose = np.zeros(3)
        pose[: len(state)] = self.grid.frame.to_local(np.asarray(state))
        return pose


def _checked_state(state: Sequence[float], name: str, robot: Robot) -> State:
    try:
        array = np.asarray(tuple(state))
    except (TypeError, ValueError) as error:
        raise InvalidProblem(f"{name} must be a sequence of numbers; got {state!r}") from error
    if array.ndim != 1 or array.dtype.kind not in "iuf":  # also strings of digits
        raise InvalidProblem(f"{name} must be a sequence of numbers; got {state!r}")
    values = tuple(array.astype(np.float64).tolist())
    if len(values) != robot.state_dimension:
        expected = "(x, y)" if robot.state_dimension == 2 else "(x, y, yaw)"
        raise InvalidProblem(
            f"{name} must be {expected} for a {type(robot).__name__}; got {len(values)} values"
        )
    if not all(math.isfinite(value) for value in values):
        raise InvalidProblem(f"{name} must be finite; got {values}")
    return values


def _check_on_map(state: State, name: str, grid: OccupancyGrid) -> None:
    if grid.contains(state[:2]):
        return
    error = StartOutsideMap if name == "start" else GoalOutsideMap
    x, y, _ = grid.origin
    raise error(
        f"{name} ({state[0]:g}, {state[1]:g}) m is outside the map, which covers "
        f"{grid.width:g} x {grid.height:g} m from its corner at ({x:g}, {y:g}) m"
    )


def _check_free(state: State, name: str, problem: Problem) -> None:
    grid, radius = problem.grid, problem.robot.radius
    row, col = grid.to_rc(state[:2])
    if not problem.blocked[row, col]:
        return
    nearest = grid.nearest_free(state[:2], radius)
    advice = (
        "the robot fits nowhere on this map"
        if nearest is None
        else f"the nearest free point is ({nearest[0]:.3f}, {nearest[1]:.3f}) m"
    )
    error = StartOccupied if name == "start" else GoalOccupied
    raise error(
        f"a robot of radius {radius:g} m is in collision at the {name} "
        f"({state[0]:g}, {state[1]:g}) m; {advice}",
        nearest,
    )
