"""Requests for plans and regions, answered by the library."""

from __future__ import annotations

import time
from collections.abc import Callable
from functools import lru_cache
from typing import NamedTuple

from planformer.api import default_planner, plan, planner_names, resolve_planner
from planformer.baselines import learned_planner_names
from planformer.errors import InvalidParameter, UnknownGuide
from planformer.guidance import (
    AUTO,
    Region,
    RegionProposer,
    default_guide,
    guide_names,
    load_network,
    resolve_guide,
)
from planformer.guidance.weights import ALIASES
from planformer.maps import OccupancyGrid
from planformer.planning import CancelToken, PlanResult, Problem, Progress
from planformer.planning.search import checked_seed
from planformer.robots import DubinsCar, PointRobot, ReedsSheppCar, Robot
from planformer.serve.answers import plan_answer, region_answer
from planformer.serve.requests import Ends, ProposeRequest, RunOptions
from planformer.serve.responses import PlanResponse, RegionResponse, RobotOptions
from planformer.serve.settings import ServeSettings

_ROBOTS: dict[str, Robot] = {
    "point": PointRobot(),
    "dubins": DubinsCar(),
    "reeds-shepp": ReedsSheppCar(),
}


class Run(NamedTuple):
    """A search that was asked for, checked."""

    grid: OccupancyGrid
    ends: Ends
    options: RunOptions
    guide: str | None
    seed: int


def robot_options() -> dict[str, RobotOptions]:
    """What there is for each kind of robot."""
    return {
        kind: RobotOptions(
            planners=planner_names(robot),
            guides=_guides(robot.state_dimension),
            default_planner=default_planner(robot),
            default_guide=default_guide(robot),
            unguided_planners=learned_planner_names(robot),
        )
        for kind, robot in _ROBOTS.items()
    }


def check_run(grid: OccupancyGrid, ends: Ends, options: RunOptions, settings: ServeSettings) -> Run:
    """A search within the service's limits, with its guide and seed.

    Raises:
        InvalidParameter: A limit is beyond what the service allows.
        UnknownPlanner: No such planner for the robot.
        UnknownGuide: The guide is none of the shipped ones.
    """
    if options.time_limit > settings.plan_seconds:
        raise InvalidParameter(
            f"time_limit must be at most {settings.plan_seconds:g} s; got {options.time_limit:g}"
        )
    if options.max_vertices is not None and options.max_vertices > settings.plan_vertices:
        raise InvalidParameter(
            f"max_vertices must be at most {settings.plan_vertices}; got {options.max_vertices}"
        )
    robot = ends.robot.robot()
    planner = resolve_planner(options.planner, robot, guided=options.guide is not None)
    options = options.model_copy(update={"planner": planner})
    learned = planner in learned_planner_names(robot)
    guide = None if learned or options.guide is None else _guide(options.guide, robot)
    return Run(grid, ends, options, guide, checked_seed(options.seed))


def check_problem(run: Run) -> None:
    """Check start, goal and guide, which takes a while for those that are new.

    Raises:
        InvalidProblem: Start or goal is off the map or in collision.
        WeightsMismatch: The guide was made for another kind of robot.
    """
    robot = run.ends.robot.robot()
    Problem(run.grid, robot, tuple(run.ends.start), tuple(run.ends.goal))
    if run.guide is not None:
        load_network(run.guide).require_fit(robot)


def execute(
    run: Run,
    cancel: CancelToken,
    settings: ServeSettings,
    *,
    on_region: Callable[[Region, float], None] | None = None,
    progress: Progress | None = None,
) -> PlanResult:
    """Search.

    Args:
        run: What to search.
        cancel: Ends the search.
        settings: Bounds.
        on_region: Gets the region and the seconds it took, before the search begins.
        progress: Gets snapshots of the search.
    """
    options = run.options
    guide: RegionProposer | None = None
    if run.guide is not None:
        guide = resolve_guide(run.guide, run.ends.robot.robot(), options.threshold)
        guide = guide if on_region is None else _Announced(guide, on_region)
    return plan(
        run.grid,
        run.ends.robot.robot(),
        run.ends.start,
        run.ends.goal,
        planner=options.planner,
        guide=guide,
        exploration=options.exploration,
        time_limit=options.time_limit,
        target_length=options.target_length,
        max_vertices=options.max_vertices or settings.plan_vertices,
        seed=run.seed,
        keep_tree=options.tree,
        cancel=cancel,
        progress=progress,
    )


def answer(run: Run, result: PlanResult) -> PlanResponse:
    """The response for a search."""
    return plan_answer(result, run.options, guide=run.guide, seed=run.seed)


def propose(grid: OccupancyGrid, request: ProposeRequest) -> RegionResponse:
    """The response for a proposal."""
    robot = request.robot.robot()
    problem = Problem(grid, robot, tuple(request.start), tuple(request.goal))
    guide = _guide(request.guide, robot)
    started = time.perf_counter()
    region = resolve_guide(guide, robot, request.threshold).propose(problem)
    return region_answer(region, guide, time.perf_counter() - started)


class _Announced:
    """A proposer whose region is known before the search begins."""

    def __init__(self, guide: RegionProposer, on_region: Callable[[Region, float], None]) -> None:
        self._guide, self._on_region = guide, on_region

    def propose(self, problem: Problem) -> Region:
        started = time.perf_counter()
        region = self._guide.propose(problem)
        self._on_region(region, time.perf_counter() - started)
        return region


def _guide(name: str, robot: Robot) -> str:
    """A guide's name; never a path, because no file may be read at a client's wish.

    Raises:
        UnknownGuide: No shipped weights have the name.
    """
    if name == AUTO:
        return default_guide(robot)
    if name not in guide_names():
        raise UnknownGuide(
            f"unknown guide {name!r}; valid: {AUTO}, {', '.join(guide_names())}, or null for none"
        )
    return name


@lru_cache(maxsize=2)
def _guides(state_dimension: int) -> list[str]:
    """Short names of the weights for a robot: those that need headings are for cars."""
    return [
        name for name in ALIASES if state_dimension == 3 or not load_network(name).scale.headings
    ]
