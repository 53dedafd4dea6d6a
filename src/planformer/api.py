"""The calls that users make: propose a region, plan inside it, and list the planners."""

from __future__ import annotations

import dataclasses
import time
from collections.abc import Sequence
from typing import cast

from planformer import planning
from planformer.baselines import learned_planner_names, load_planner
from planformer.errors import InvalidParameter, UnknownPlanner
from planformer.guidance import AUTO, Guide, Region, resolve_guide
from planformer.maps import OccupancyGrid
from planformer.planning import (
    CancelToken,
    PlanResult,
    Problem,
    Progress,
    SearchLimits,
    search,
)
from planformer.planning.problem import State
from planformer.robots import DubinsCar, Robot


def plan(
    grid: OccupancyGrid,
    robot: Robot,
    start: Sequence[float],
    goal: Sequence[float],
    *,
    planner: str = AUTO,
    guide: Guide | None = AUTO,
    threshold: float | None = None,
    exploration: float = 0.0,
    refinement: float | None = None,
    time_limit: float | None = 5.0,
    target_length: float | None = None,
    max_vertices: int | None = None,
    seed: int | None = None,
    keep_tree: bool = False,
    cancel: CancelToken | None = None,
    progress: Progress | None = None,
) -> PlanResult:
    """Plan a path, guided by a region that a network proposes.

    An optimising planner (RRTstar, BITstar, ...) uses the whole time limit unless a target length
    or a number of vertices ends it earlier.

    Args:
        grid: The map.
        robot: A `PointRobot`, `DubinsCar` or `ReedsSheppCar`.
        start: (x, y) or, for a car, (x, y, yaw) in the world frame, metres and rad.
        goal: As the start.
        planner: "auto" for `default_planner`, an OMPL class name, or a learned planner that plans
            by itself (MPNet, NEXT-KS); `planner_names(robot)` lists them.
        guide: "auto" for `default_guide`, the name of shipped weights, the path of an .onnx file, a
            `RegionProposer`, or None for an unguided planner. A learned planner does without, and
            without threshold, exploration and refinement.
        threshold: Probability above which an anchor belongs to the region: 0.5 as in the paper, or
            None to choose the one that connects start and goal in this query. Only for a guide
            given by name.
        exploration: Share of samples drawn from the whole map instead of the region; 0.5 = the
            paper's alternation of exploitation and exploration (-EE).
        refinement: Share of samples drawn near the best path so far, once there is one, which may
            leave the region; exploration is a share of the others. 0 = OMPL's planner as it is,
            None = 0.5 with a guide, 0.2 without. AITstar, LazyPRMstar and SST do not refine.
        time_limit: Wall-clock limit of the search in seconds, None for none.
        target_length: Stop at the first path at most this long, in metres.
        max_vertices: Stop when the tree holds this many states.
        seed: 0 to 2**32 - 1 for a reproducible search (unless the time limit ends it).
        keep_tree: Return the search tree, for pictures; learned planners return none.
        cancel: A `CancelToken` whose `cancel()` ends the search from another thread.
        progress: A `Progress` whose `latest()` tells another thread what the search has found;
            learned planners tell nothing.

    Returns:
        The result. No path within the limits is a result as well: see its `status`.

    Raises:
        InvalidProblem: Start or goal is off the map or in collision (see its subclasses).
        UnknownPlanner: No such planner for this robot. Likewise UnknownGuide.
        InvalidMap: The map is too large for the guide.
        InvalidWeights: The guide's files are damaged.
        WeightsMismatch: The guide was made for another kind of robot.
        InvalidParameter: Another value is out of range.
    """
    problem = Problem(grid, robot, cast(State, start), cast(State, goal))
    if progress is not None:
        progress.begin(problem)  # of a former search it has nothing to tell from now on
    limits = SearchLimits(time_limit, target_length, max_vertices)
    planner = resolve_planner(planner, robot, guided=guide is not None)
    if planner in learned_planner_names(robot):
        return load_planner(planner).search(problem, limits=limits, seed=seed, cancel=cancel)
    if guide is None and threshold is not None:
        raise InvalidParameter("a threshold needs the name of weights as guide")
    region, seconds = None, 0.0
    if guide is not None:
        started = time.perf_counter()
        proposer = resolve_guide(guide, robot, threshold)
        if problem.is_connected and not (cancel is not None and cancel.is_cancelled):
            region = proposer.propose(problem)
        seconds = time.perf_counter() - started
    result = search(
        problem,
        planner,
        region=None if region is None else region.sampling(),
        exploration=exploration,
        refinement=refinement,
        limits=limits,
        seed=seed,
        keep_tree=keep_tree,
        cancel=cancel,
        progress=progress,
    )
    return dataclasses.replace(result, region=region, proposal_seconds=seconds)


def default_planner(robot: Robot, *, guided: bool = True) -> str:
    """The planner that does best for a robot over all kinds of maps (docs/performance.md).

    BIT* in a region is far ahead in mazes and on large maps, and close behind RRT* in forests.

    Args:
        robot: The robot.
        guided: Whether it will search in a region.
    """
    return "BITstar" if guided and not isinstance(robot, DubinsCar) else "InformedRRTstar"


def resolve_planner(planner: str, robot: Robot, *, guided: bool) -> str:
    """Turn "auto" into `default_planner`, and check another name.

    Raises:
        UnknownPlanner: No such planner for this robot.
    """
    if planner == AUTO:
        return default_planner(robot, guided=guided)
    if planner not in (names := planner_names(robot)):
        raise UnknownPlanner(
            f"unknown planner {planner!r} for a {type(robot).__name__}; valid names: "
            f"{', '.join(names)}"
        )
    return planner


def planner_names(robot: Robot) -> list[str]:
    """Names of the planners that `plan` has for a robot: OMPL's classes, then the learned ones."""
    return [*planning.planner_names(robot), *learned_planner_names(robot)]


def propose_region(
    grid: OccupancyGrid,
    robot: Robot,
    start: Sequence[float],
    goal: Sequence[float],
    *,
    guide: Guide = AUTO,
    threshold: float | None = None,
) -> Region:
    """Propose where on the map a good path runs, without planning.

    Arguments and errors are those of `plan`, but that there is no proposal without a guide.
    """
    problem = Problem(grid, robot, cast(State, start), cast(State, goal))
    return resolve_guide(guide, robot, threshold).propose(problem)
