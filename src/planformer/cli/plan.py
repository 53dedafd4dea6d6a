"""`planformer plan`: from a map, a start and a goal to a path, a summary and a picture."""

from __future__ import annotations

from enum import Enum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from planformer.cli import exit_codes
from planformer.cli.console import print_json, stderr
from planformer.cli.states import METAVAR, parse_state
from planformer.errors import InvalidParameter

if TYPE_CHECKING:
    from planformer.planning import PlanResult
    from planformer.robots import Robot

_UNGUIDED = "none"


class RobotKind(str, Enum):
    """Robots by their name on the command line."""

    POINT = "point"
    DUBINS = "dubins"
    REEDS_SHEPP = "reeds-shepp"


def plan_command(
    map_file: Annotated[
        Path,
        typer.Argument(metavar="MAP", help="Map: ROS .yaml, MovingAI .map, .npy or a picture."),
    ],
    start: Annotated[
        str, typer.Option(metavar=METAVAR, help="Start in the map's world frame, metres and rad.")
    ],
    goal: Annotated[str, typer.Option(metavar=METAVAR, help="Goal, as the start.")],
    robot: Annotated[
        RobotKind,
        typer.Option(
            metavar="NAME",
            help="point (a disc), dubins (a car) or reeds-shepp (a car that reverses).",
        ),
    ] = RobotKind.POINT,
    radius: Annotated[
        float | None,
        typer.Option(help="Radius of the robot in metres. Default: 0.1, for a car 0.2."),
    ] = None,
    turning_radius: Annotated[
        float | None, typer.Option(help="Tightest circle of a car in metres. Default: 0.55.")
    ] = None,
    planner: Annotated[
        str,
        typer.Option(
            help="OMPL class name; `planformer info` lists them. Default: the best for the robot."
        ),
    ] = "auto",
    guide: Annotated[
        str,
        typer.Option(
            help="Shipped weights, the path of an .onnx file, or 'none'. "
            "Default: the weights for the robot."
        ),
    ] = "auto",
    threshold: Annotated[
        float | None,
        typer.Option(
            help="Fixed threshold of the region; 0.5 is the paper's. "
            "Default: chosen so that start and goal are connected."
        ),
    ] = None,
    exploration: Annotated[
        float, typer.Option(help="Share of the samples drawn from the whole map, 0 to 1.")
    ] = 0.0,
    time_limit: Annotated[float, typer.Option(help="Seconds of the search.")] = 5.0,
    target_length: Annotated[
        float | None, typer.Option(help="Stop at a path at most this long, in metres.")
    ] = None,
    max_vertices: Annotated[
        int | None, typer.Option(help="Stop when the tree holds this many states.")
    ] = None,
    seed: Annotated[
        int | None, typer.Option(help="Seed of the search. Default: a new one, which is reported.")
    ] = None,
    resolution: Annotated[
        float | None,
        typer.Option(help="Metres a cell of a map that does not state it. Default: 0.05."),
    ] = None,
    unknown_is_free: Annotated[
        bool, typer.Option("--unknown-is-free", help="Let the robot enter unknown space.")
    ] = False,
    output: Annotated[
        Path | None,
        typer.Option(
            metavar="FOLDER",
            help="Folder for path.csv, path.json and picture.png. "
            "Default: MAP_plan here; with --json, nothing is written.",
        ),
    ] = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print the result as JSON and nothing else.")
    ] = False,
    no_picture: Annotated[bool, typer.Option("--no-picture", help="Draw no picture.")] = False,
) -> None:
    """Plan a path on a map; write the path and a picture.

    Exit codes: 0 path found, 1 no path, 2 bad input, 130 interrupted. Ctrl-C ends the search and
    keeps the best path found so far.

    Example: planformer plan depot.yaml --start 2 2 --goal 27 12
    """
    import numpy as np

    from planformer.api import default_planner, plan
    from planformer.baselines import learned_planner_names
    from planformer.cli.interrupt import stoppable
    from planformer.cli.report import PlanReport, require_writable
    from planformer.guidance import AUTO, default_guide
    from planformer.maps import load_map

    ends = parse_state(start, "--start"), parse_state(goal, "--goal")
    body = make_robot(robot, radius, turning_radius)
    if planner in learned_planner_names(body):
        if guide not in (AUTO, _UNGUIDED) or threshold is not None or exploration:
            raise InvalidParameter(
                f"{planner} plans by itself: leave out --guide, --threshold and --exploration"
            )
        guide = _UNGUIDED
    if resolution is None:
        _require_no_description(map_file)
    grid = load_map(map_file, resolution=resolution, unknown_is_occupied=not unknown_is_free)
    folder = output if output or as_json else Path(f"{map_file.stem}_plan")
    if folder is not None:
        require_writable(folder)  # before the search, not after it
    weights = None if guide == _UNGUIDED else default_guide(body) if guide == AUTO else guide
    if planner == AUTO:
        planner = default_planner(body, guided=weights is not None)
    seed = int(np.random.default_rng().integers(2**32)) if seed is None else seed
    with stderr.status(f"Planning for at most {time_limit:g} s; Ctrl-C keeps the best path"):
        result = stoppable(
            lambda cancel: plan(
                grid,
                body,
                *ends,
                planner=planner,
                guide=weights,
                threshold=threshold,
                exploration=exploration,
                time_limit=time_limit,
                target_length=target_length,
                max_vertices=max_vertices,
                seed=seed,
                keep_tree=not no_picture and folder is not None,
                cancel=cancel,
            )
        )
    done = PlanReport(
        map_file=map_file,
        robot_kind=robot.value,
        planner=planner,
        guide=weights,
        seed=seed,
        result=result,
        folder=folder,
        picture=not no_picture,
    )
    with stderr.status("Writing"):
        done.write()
    if as_json:
        print_json(done.record())
    else:
        done.print()
    raise typer.Exit(exit_code(result))


def _require_no_description(picture: Path) -> None:
    """Refuse a ROS map's picture: alone it does not say what is unknown, nor its scale."""
    from planformer.maps.folder import description_of

    if description := description_of(picture):
        raise InvalidParameter(
            f"{picture} belongs to {description}, which says what is unknown and how large a cell "
            "is: plan on that file, or give --resolution to take the picture alone"
        )


def make_robot(kind: RobotKind, radius: float | None, turning_radius: float | None) -> Robot:
    """The robot that the options describe.

    Raises:
        InvalidRobot: A dimension is out of range.
        InvalidParameter: A turning radius is given for a robot that turns on the spot.
    """
    from planformer.robots import DubinsCar, PointRobot, ReedsSheppCar

    sizes = {"radius": radius, "turning_radius": turning_radius}
    given = {name: value for name, value in sizes.items() if value is not None}
    if kind is RobotKind.POINT:
        if turning_radius is not None:
            raise InvalidParameter("--turning-radius needs --robot dubins or reeds-shepp")
        return PointRobot(**given)
    return DubinsCar(**given) if kind is RobotKind.DUBINS else ReedsSheppCar(**given)


def exit_code(result: PlanResult) -> int:
    """The exit code that tells how a plan ended."""
    from planformer.planning import PlanStatus

    if result.status is PlanStatus.CANCELLED:
        return exit_codes.INTERRUPTED
    return exit_codes.SOLVED if result.solved else exit_codes.NO_PATH
