"""From a costmap, a start and a goal to a problem that planformer solves."""

from __future__ import annotations

import math
from dataclasses import dataclass

from planformer import Problem
from planformer.errors import InvalidMap, InvalidProblem
from planformer.maps import Costmap
from planformer.maps.costmap import check_goal, with_way_out

from planformer_ros.settings import Settings
from planformer_ros.world import Snapshot

Pose = tuple[float, float, float]
"""x, y [m] and yaw [rad] in the frame of the map."""

_PIXEL = 0.05
"""Side [m] of a pixel of the shipped networks."""


@dataclass(frozen=True)
class Prepared:
    """A problem with the costmap that it was made from.

    Attributes:
        problem: The problem, of a robot without extent.
        costmap: The costmap, inflated by what was missing of the robot's radius, on which the
            robot's way out of an inscribed zone is open.
    """

    problem: Problem
    costmap: Costmap


def prepare(snapshot: Snapshot, start: Pose, goal: Pose, settings: Settings) -> Prepared:
    """Make a problem of a map, a start and a goal.

    Raises:
        InvalidMap: The map is larger than the settings allow.
        InvalidProblem: The start or the goal is off the map or in closed space (see its
            subclasses), or its yaw is no number.
    """
    _check_size(snapshot.costmap, settings.max_pixels)
    radius = settings.costmap_radius if snapshot.is_inflated else settings.robot_radius
    costmap = snapshot.for_robot(radius, unknown_is_free=settings.allow_unknown)
    costmap = with_way_out(costmap, start, settings.start_reach)
    check_goal(costmap, goal)
    for name, pose in (("start", start), ("goal", goal)):
        if not math.isfinite(pose[2]):
            raise InvalidProblem(f"the orientation of the {name} is no unit quaternion")
    robot = settings.make_robot()
    length = robot.state_dimension
    return Prepared(Problem(costmap.grid, robot, start[:length], goal[:length]), costmap)


def _check_size(costmap: Costmap, limit: int) -> None:
    """A few cells of great size would become many pixels for a network."""
    cells = costmap.costs.size
    pixels = cells * (costmap.resolution / _PIXEL) ** 2
    if max(cells, pixels) > limit:
        raise InvalidMap(
            f"a map of {cells} cells of {costmap.resolution:g} m is {pixels:.3g} pixels for a "
            f"network; max_pixels allows {limit}"
        )
