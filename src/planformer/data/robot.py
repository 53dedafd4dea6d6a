"""The robots that data sets are made for, by name."""

from __future__ import annotations

from planformer.errors import InvalidParameter
from planformer.robots import DubinsCar, PointRobot, Robot

ROBOTS = ("dubins", "point")


def make_robot(name: str, radius: float, turning_radius: float | None) -> Robot:
    """The robot of a data set.

    Args:
        name: One of `ROBOTS`.
        radius: Radius of its disc in metres.
        turning_radius: Radius of the car's tightest circle in metres; None for a point robot.

    Raises:
        InvalidParameter: The name is unknown, or the robot has no or needs a turning radius.
        InvalidRobot: A radius is out of range.
    """
    if name not in ROBOTS:
        raise InvalidParameter(f"robot must be one of {', '.join(ROBOTS)}; got {name!r}")
    if name == "point":
        if turning_radius is not None:
            raise InvalidParameter(
                f"turning_radius is for the robot dubins; got {turning_radius} for a point robot"
            )
        return PointRobot(radius)
    if turning_radius is None:
        raise InvalidParameter("the robot dubins needs a turning_radius in metres; got None")
    return DubinsCar(radius, turning_radius)


def robot_settings(robot: Robot) -> tuple[str, float, float | None]:
    """Name, radius and turning radius of a robot: the arguments of `make_robot`."""
    if isinstance(robot, DubinsCar):
        return "dubins", robot.radius, robot.turning_radius
    return "point", robot.radius, None
