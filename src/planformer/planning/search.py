"""Search: run one of OMPL's planners on a problem, inside a region or on the whole map."""

from __future__ import annotations

import math
import threading
import time
from dataclasses import dataclass
from numbers import Integral

import cv2
import numpy as np
from numpy.typing import NDArray

from planformer import _core
from planformer.errors import InvalidParameter, UnknownPlanner
from planformer.geometry import Frame, wrap_angle
from planformer.planning.problem import Problem, State
from planformer.planning.progress import Progress
from planformer.planning.result import PlanResult, PlanStatus, Tree
from planformer.planning.sampling import (
    REFINEMENT,
    REFINEMENT_IN_REGION,
    YAW_DEVIATION,
    SamplingRegion,
)
from planformer.planning.validity import path_is_valid
from planformer.robots import DubinsCar, Robot

_SAME_STATE = 1e-9
"""States that differ by no more [m, rad] are the same, a turn by 2 pi included."""

CancelToken = _core.Cancellation
"""Ends a plan from another thread: pass it to `plan` and call its `cancel()`."""

_STATUS = {
    _core.Outcome.FINISHED: PlanStatus.FINISHED,
    _core.Outcome.TARGET: PlanStatus.TARGET_REACHED,
    _core.Outcome.TIME_LIMIT: PlanStatus.TIME_LIMIT,
    _core.Outcome.VERTEX_LIMIT: PlanStatus.VERTEX_LIMIT,
    _core.Outcome.CANCELLED: PlanStatus.CANCELLED,
}


@dataclass(frozen=True)
class SearchLimits:
    """When a search ends; None means no limit.

    Attributes:
        seconds: Wall-clock limit.
        target_length: Stop at the first path at most this long, in metres.
        max_vertices: Stop when the tree holds this many states.

    Raises:
        InvalidParameter: A limit is not positive, or a number of vertices is not whole.
    """

    seconds: float | None = 5.0
    target_length: float | None = None
    max_vertices: int | None = None

    def __post_init__(self) -> None:
        for name in ("seconds", "target_length", "max_vertices"):
            value = getattr(self, name)
            if value is not None and not value > 0:
                raise InvalidParameter(f"{name} must be > 0 or None; got {value}")
        if not isinstance(self.max_vertices, Integral | None):
            raise InvalidParameter(f"max_vertices must be whole; got {self.max_vertices}")


def planner_names(robot: Robot) -> list[str]:
    """OMPL class names of the planners that this build has for a robot."""
    return list(_core.planner_names(_model(robot)[0]))


def search(
    problem: Problem,
    planner: str,
    *,
    region: SamplingRegion | None = None,
    exploration: float = 0.0,
    refinement: float | None = None,
    limits: SearchLimits | None = None,
    seed: int | None = None,
    keep_tree: bool = False,
    cancel: _core.Cancellation | None = None,
    progress: Progress | None = None,
) -> PlanResult:
    """Plan with one of OMPL's planners.

    Args:
        problem: The problem.
        planner: OMPL class name, see `planner_names`.
        region: Where samples are drawn; None for the whole map.
        exploration: Share of the samples drawn from the whole map, 0 to 1.
        refinement: Share of the samples drawn near the best path, 0 to 1, once there is one; they
            may leave the region, and exploration is a share of the others. 0 gives OMPL's planner
            as it is; None is `REFINEMENT`, or `REFINEMENT_IN_REGION` in one. AITstar,
            LazyPRMstar and SST do not refine.
        limits: When to stop; five seconds by default.
        seed: 0 to 2**32 - 1; the same seed gives the same result unless the time limit ends the
            search. None draws one.
        keep_tree: Return the search tree.
        cancel: Ends the search when cancelled from another thread.
        progress: Gets snapshots of the search.

    Returns:
        The result; its path has passed `path_is_valid`.

    Raises:
        UnknownPlanner: The name is unknown or the planner does not fit the robot.
        InvalidParameter: A value is out of range.
    """
    started = time.perf_counter()
    names = planner_names(problem.robot)
    if planner not in names:
        raise UnknownPlanner(
            f"unknown planner {planner!r} for a {type(problem.robot).__name__}; "
            f"valid names: {', '.join(names)}"
        )
    if refinement is None:
        refinement = REFINEMENT if region is None else REFINEMENT_IN_REGION
    for name, share in (("exploration", exploration), ("refinement", refinement)):
        if not 0.0 <= share <= 1.0:
            raise InvalidParameter(f"{name} must be between 0 and 1; got {share}")
    seed = checked_seed(seed)
    record = None if progress is None else progress.begin(problem)
    if _starts_at_goal(problem):
        return _without_search(problem, PlanStatus.FINISHED, [problem.start, problem.goal], started)
    if not problem.is_connected:
        return _without_search(problem, PlanStatus.UNREACHABLE, [], started)
    limits = limits or SearchLimits()
    core_region = None if region is None else _core_region(region, problem)
    preparation = time.perf_counter() - started
    answer = _core.plan(
        problem.blocked,
        problem.grid.resolution,
        _core.RobotModel(*_model(problem.robot)),
        problem.local_start.tolist(),
        problem.local_goal.tolist(),
        planner=planner,
        region=core_region,
        exploration=exploration,
        refinement=refinement,
        limits=_core.Limits(limits.seconds, limits.target_length, _vertex_limit(limits)),
        seed=seed,
        keep_tree=keep_tree,
        cancellation=cancel,
        progress=record,
        # Ctrl-C reaches the main thread alone; others would only wait for each other's Python.
        handle_signals=threading.current_thread() is threading.main_thread(),
    )
    return _to_result(answer, problem, preparation, keep_tree=keep_tree)


def _vertex_limit(limits: SearchLimits) -> int | None:
    """More than the core can count is no limit."""
    return None if limits.max_vertices is None else min(int(limits.max_vertices), 2**64 - 1)


def _starts_at_goal(problem: Problem) -> bool:
    """Planners differ in what they do then: most search on, some drive a loop."""
    offset = problem.local_goal - problem.local_start
    offset[2] = wrap_angle(offset[2])
    return bool((np.abs(offset) <= _SAME_STATE).all())


def is_connected(free: NDArray[np.bool_], problem: Problem) -> bool:
    """Whether start and goal share a 4-connected component of (H, W) bool cells.

    Four neighbours are exact: a motion through a corner touches the cells beside it.
    """
    _, labels = cv2.connectedComponents(free.view(np.uint8), connectivity=4, ltype=cv2.CV_32S)
    (r0, c0), (r1, c1) = problem.grid.to_rc([problem.start[:2], problem.goal[:2]])
    return bool(labels[r0, c0] != 0 and labels[r0, c0] == labels[r1, c1])


def _model(robot: Robot) -> tuple[_core.RobotKind, float, bool, float, float]:
    if isinstance(robot, DubinsCar):
        return (
            _core.RobotKind.CAR,
            robot.turning_radius,
            robot.reverses,
            robot.wheelbase,
            robot.max_speed,
        )
    return (_core.RobotKind.POINT, 0.0, False, 0.0, 0.0)


def _core_region(region: SamplingRegion, problem: Problem) -> _core.Region:
    headings = np.zeros(len(region.anchors)) if region.headings is None else region.headings
    poses = problem.grid.frame.to_local(np.column_stack((region.anchors, headings)))
    ends = None
    if isinstance(problem.robot, DubinsCar) and region.headings is not None:
        start, goal = problem.local_start.tolist(), problem.local_goal.tolist()
        ends = _core.Ends(start, goal, problem.robot.turning_radius)
    return _core.Region(
        np.ascontiguousarray(poses),
        np.zeros_like(region.anchors)
        if region.offsets is None
        else Frame(yaw=problem.grid.frame.yaw).to_local(region.offsets),
        has_heading=region.headings is not None,
        half_width=region.half_width,
        minor_axis=region.minor_axis,
        yaw_deviations=(
            np.full(len(headings), YAW_DEVIATION)
            if region.yaw_deviations is None
            else region.yaw_deviations
        ),
        ends=ends,
        area=region.area,
    )


def checked_seed(seed: int | None) -> int:
    """A seed, drawn where there is none.

    Raises:
        InvalidParameter: It is no whole number from 0 to 2**32 - 1.
    """
    if seed is None:
        return int(np.random.default_rng().integers(1, 2**32))
    if not (isinstance(seed, Integral) and 0 <= seed < 2**32):
        raise InvalidParameter(f"seed must be whole, between 0 and 2**32 - 1; got {seed}")
    return int(seed)


def _to_result(
    answer: _core.Answer, problem: Problem, preparation: float, *, keep_tree: bool
) -> PlanResult:
    dimension, frame = problem.robot.state_dimension, problem.grid.frame
    tree = Tree.from_core(answer, problem) if keep_tree else None
    checking = time.perf_counter()
    path = frame.to_world(answer.path)[:, :dimension]
    status = _STATUS[answer.outcome]
    if len(path):
        # The rounding of the frame's rotation must not move what the caller gave.
        path[0] = problem.start
        path[-1] = problem.goal
        if not path_is_valid(problem.grid, problem.robot, path):
            path, status = path[:0], PlanStatus.INVALID_PATH
    return PlanResult(
        problem=problem,
        solved=len(path) > 0,
        status=status,
        path=path,
        length=float(answer.length) if len(path) else math.inf,
        vertices=int(answer.vertices),
        # Counting vertices and copying the tree is reporting, not planning.
        planning_seconds=preparation + answer.seconds + time.perf_counter() - checking,
        tree=tree,
    )


def _without_search(
    problem: Problem, status: PlanStatus, states: list[State], started: float
) -> PlanResult:
    """The result where the answer is plain: `states` is a path without length or no path."""
    return PlanResult(
        problem=problem,
        solved=len(states) > 0,
        status=status,
        path=np.array(states, dtype=np.float64).reshape(-1, problem.robot.state_dimension),
        length=0.0 if states else math.inf,
        vertices=0,
        planning_seconds=time.perf_counter() - started,
    )
