"""What users can set, checked; each value carries the description and range that ROS shows."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Annotated, get_type_hints

import planformer as pf
from planformer.errors import InvalidParameter
from planformer.guidance import load_network
from planformer.robots import Robot

_ROBOTS = ("point", "dubins", "reeds_shepp")


@dataclass(frozen=True)
class About:
    """What a user needs to know of a setting.

    Attributes:
        description: What it does, with its unit.
        between: Lowest and highest value, None for a value that is no number.
        one_of: The valid names, empty for any.
    """

    description: str
    between: tuple[float, float] | None = None
    one_of: tuple[str, ...] = ()


def about(settings: type) -> dict[str, About]:
    """What there is to know of each field of a dataclass of settings."""
    hints = get_type_hints(settings, include_extras=True)
    return {item.name: hints[item.name].__metadata__[0] for item in fields(settings)}


def check_ranges(settings: Settings | Wiring) -> None:
    """Check each field against what is said about it.

    Raises:
        InvalidParameter: A value is out of range; the message names it and the rule.
    """
    for name, rule in about(type(settings)).items():
        value, between = getattr(settings, name), rule.between
        if between is not None and not between[0] <= value <= between[1]:  # also NaN
            raise InvalidParameter(
                f"{name} must be between {between[0]} and {between[1]}; got {value}"
            )
        if rule.one_of and value not in rule.one_of:
            raise InvalidParameter(f"{name} must be one of {', '.join(rule.one_of)}; got {value!r}")


@dataclass(frozen=True)
class Settings:
    """How to plan; can be changed while the node runs.

    Raises:
        InvalidParameter: A value is out of range.
    """

    robot: Annotated[
        str,
        About(
            "point: moves in any direction; dubins: a car that drives forward; reeds_shepp: a car "
            "that reverses as well",
            one_of=_ROBOTS,
        ),
    ] = "point"
    robot_radius: Annotated[
        float,
        About(
            "radius of the robot [m]; a plain map (map_topic) is inflated by it",
            between=(0.0, 10.0),
        ),
    ] = 0.22
    costmap_radius: Annotated[
        float,
        About(
            "what the inflation of the costmap lacks of the robot's radius [m]: 0 where Nav2's "
            "inflation layer knows the robot",
            between=(0.0, 10.0),
        ),
    ] = 0.0
    costmap_timeout: Annotated[
        float,
        About(
            "age [s] beyond which nothing is planned on a costmap, as its sender seems to be gone; "
            "0: no limit",
            between=(0.0, 3600.0),
        ),
    ] = 5.0
    turning_radius: Annotated[
        float, About("smallest turning radius of a car [m]", between=(0.01, 100.0))
    ] = 0.55
    planner: Annotated[
        str,
        About(
            "planner for goals that name none: a class of OMPL, MPNet or NEXT-KS, or auto (the one "
            "recommended for the robot)"
        ),
    ] = "auto"
    planner_ids: Annotated[
        tuple[str, ...],
        About(
            "names under which a behaviour tree asks for this planner; other names have to be "
            "planners of planformer"
        ),
    ] = ("GridBased",)
    guide: Annotated[
        str,
        About(
            "weights that propose the region: a name, the path of an .onnx file, auto (the ones "
            "recommended for the robot) or none"
        ),
    ] = "auto"
    threshold: Annotated[
        float,
        About(
            "probability from which a cell belongs to the region; -1: so that start and goal are "
            "connected, for each query anew",
            between=(-1.0, 1.0),
        ),
    ] = -1.0
    exploration: Annotated[
        float, About("share of the samples that are drawn from the whole map", between=(0.0, 1.0))
    ] = 0.0
    time_limit: Annotated[
        float,
        About(
            "longest time until a path is there [s], the proposal and a fallback included",
            between=(0.01, 600.0),
        ),
    ] = 1.0
    guided_share: Annotated[
        float,
        About(
            "share of the time limit for the search in the region, if there is a fallback",
            between=(0.05, 1.0),
        ),
    ] = 0.5
    max_vertices: Annotated[
        int,
        About(
            "size of the search tree at which an optimising planner stops; 0: only when time is up",
            between=(0, 10_000_000),
        ),
    ] = 0
    fallback: Annotated[
        bool, About("plan on the whole map where there is no region, or no path in it")
    ] = True
    allow_unknown: Annotated[bool, About("whether unknown cells may be driven through")] = False
    start_reach: Annotated[
        float,
        About(
            "how far a start in the inscribed zone may be from passable space [m]",
            between=(0.0, 10.0),
        ),
    ] = 0.5
    path_spacing: Annotated[
        float, About("longest way between neighbouring poses of a path [m]", between=(0.001, 10.0))
    ] = 0.05
    max_pixels: Annotated[
        int,
        About(
            "largest map, in cells and in pixels of the network (0.05 m); larger ones are refused",
            between=(1, 2**26),
        ),
    ] = 2**24
    seed: Annotated[
        int, About("seed of the planner, -1 for another one each time", between=(-1, 2**32 - 1))
    ] = -1

    def __post_init__(self) -> None:
        check_ranges(self)
        if not (self.threshold == -1.0 or self.threshold >= 0.0):
            raise InvalidParameter(
                f"threshold must be between 0 and 1, or -1; got {self.threshold}"
            )

    def make_robot(self) -> Robot:
        """The robot on a costmap that is inflated by its radius: it has none of its own."""
        if self.robot == "point":
            return pf.PointRobot(radius=0.0)
        car = pf.DubinsCar if self.robot == "dubins" else pf.ReedsSheppCar
        return car(radius=0.0, turning_radius=self.turning_radius)

    @property
    def guide_name(self) -> str | None:
        """The weights to use, None for none."""
        if self.guide == "none":
            return None
        return self.recommended_guide if self.guide == "auto" else self.guide

    @property
    def recommended_guide(self) -> str:
        """The weights that suit the robot."""
        return pf.default_guide(self.make_robot())

    @property
    def optional_threshold(self) -> float | None:
        """The threshold as `planformer.plan` takes it."""
        return None if self.threshold < 0.0 else self.threshold

    @property
    def optional_seed(self) -> int | None:
        """The seed as `planformer.plan` takes it."""
        return None if self.seed < 0 else self.seed

    def check_names(self) -> None:
        """Check that the planner and the weights exist, and load the weights.

        Raises:
            UnknownPlanner: No such planner for this robot. Likewise UnknownGuide.
            InvalidWeights: The weights are damaged.
        """
        self.planner_for(self.planner)
        if self.guide_name is not None:
            load_network(self.guide_name)

    def planner_for(self, name: str) -> str:
        """The planner that a goal's planner_id means.

        Raises:
            UnknownPlanner: The name is none of `planner_ids` and no planner for this robot.
        """
        if not name or name in self.planner_ids:
            name = self.planner
        if name == "auto":
            return pf.default_planner(self.make_robot(), guided=self.guide_name is not None)
        if name not in (names := pf.planner_names(self.make_robot())):
            raise pf.errors.UnknownPlanner(
                f"unknown planner {name!r} for a robot of the kind {self.robot}; valid names: "
                f"{', '.join([*self.planner_ids, *names])}"
            )
        return name


@dataclass(frozen=True)
class Wiring:
    """What connects the node to others; fixed when it starts.

    Raises:
        InvalidParameter: A value is out of range.
    """

    map_topic: Annotated[str, About("plain map, used until a costmap arrives; empty: none")] = "map"
    map_subscribe_transient_local: Annotated[
        bool, About("whether the map's sender keeps it for those who come late, as map_server does")
    ] = True
    costmap_topic: Annotated[
        str, About("costmap that Nav2 publishes, with its updates on <topic>_updates; empty: none")
    ] = "global_costmap/costmap"
    global_frame: Annotated[str, About("frame of the map, the costmap and the paths")] = "map"
    robot_base_frame: Annotated[str, About("frame of the robot, for goals without a start")] = (
        "base_link"
    )
    transform_timeout: Annotated[
        float, About("longest wait for a transform [s]", between=(0.0, 60.0))
    ] = 0.1
    autostart: Annotated[bool, About("configure and activate the node when it starts")] = False

    def __post_init__(self) -> None:
        check_ranges(self)
        if not self.global_frame:
            raise InvalidParameter("global_frame must not be empty")
