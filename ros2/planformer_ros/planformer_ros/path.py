"""Answers goals: plans in the proposed region, falls back, and follows a map that changes."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
import planformer as pf
from numpy.typing import NDArray
from planformer.baselines import learned_planner_names
from planformer.errors import PlanformerError
from planformer.maps import Costmap

from planformer_ros.error_codes import (
    Cancelled,
    ErrorCode,
    OutOfTime,
    code_of,
    error_of,
)
from planformer_ros.poses import to_poses
from planformer_ros.problem import Pose, Prepared, prepare
from planformer_ros.region import propose
from planformer_ros.settings import Settings
from planformer_ros.world import Snapshot

Newest = Callable[[], Snapshot | None]
_SHORTEST_SEARCH = 1e-3
"""Less time [s] than this is none."""


@dataclass(frozen=True)
class PathAnswer:
    """The answer to a goal.

    Attributes:
        poses: (N, 3) float64 x, y [m] and yaw [rad] in the frame of the map; (0, 3) without a path.
        seconds: Time that it took.
        code: NONE, or why there is no path.
        message: The same in words.
        cancelled: Whether it was given up because nobody wanted it any more.
        region: (H, W) bool, the region that it was searched in; None for the whole map.
        costmap: The map that the region is of.
        fallback: Why the search did not stay in a region, empty if it did or should not.
    """

    poses: NDArray[np.float64] = field(default_factory=lambda: np.empty((0, 3)))
    seconds: float = 0.0
    code: ErrorCode = ErrorCode.NONE
    message: str = ""
    cancelled: bool = False
    region: NDArray[np.bool_] | None = None
    costmap: Costmap | None = None
    fallback: str = ""


@dataclass(frozen=True)
class _Found:
    result: pf.PlanResult
    costmap: Costmap
    region: pf.Region | None = None
    fallback: str = ""


def answer_path(
    newest: Newest,
    start: Pose,
    goal: Pose,
    planner_id: str,
    settings: Settings,
    cancel: pf.CancelToken,
) -> PathAnswer:
    """Plan a path that is valid on the newest map.

    Args:
        newest: Gives the newest map whenever it is called.
        start: Pose in the frame of the map.
        goal: As the start.
        planner_id: As in Nav2's action; see `Settings.planner_for`.
        settings: The settings.
        cancel: Ends the search from another thread.
    """
    started = time.perf_counter()
    try:
        planner = settings.planner_for(planner_id)
        search = _Search(planner, settings, started + settings.time_limit, cancel)
        found = _plan_until_valid(newest, start, goal, search)
        poses = to_poses(found.result.path, goal[2], settings.path_spacing)
    except Cancelled as error:
        return PathAnswer(seconds=time.perf_counter() - started, message=str(error), cancelled=True)
    except PlanformerError as error:
        return PathAnswer(
            seconds=time.perf_counter() - started, code=code_of(error), message=str(error)
        )
    return PathAnswer(
        poses=poses,
        seconds=time.perf_counter() - started,
        costmap=found.costmap,
        region=None if found.region is None else found.region.mask,
        fallback=found.fallback,
    )


def _plan_until_valid(newest: Newest, start: Pose, goal: Pose, search: _Search) -> _Found:
    """Plan, and plan again as long as the map has changed meanwhile so that the path is blocked."""
    snapshot = newest()
    if snapshot is None:
        raise OutOfTime("there is no map yet")
    _check_age(snapshot, search.settings.costmap_timeout)
    prepared = prepare(snapshot, start, goal, search.settings)
    while True:
        found = search.run(prepared)
        now = newest()
        if now is None or now is snapshot:
            return found
        prepared, snapshot = prepare(now, start, goal, search.settings), now
        if pf.path_is_valid(prepared.problem.grid, prepared.problem.robot, found.result.path):
            return found


def _check_age(snapshot: Snapshot, limit: float) -> None:
    """Refuse a costmap whose sender seems to be gone: obstacles may have come since."""
    age = time.monotonic() - snapshot.received
    if snapshot.is_inflated and 0.0 < limit < age:
        raise OutOfTime(f"the costmap is {age:.1f} s old; costmap_timeout allows {limit:g} s")


@dataclass(frozen=True)
class _Search:
    """Runs a planner, first in a region and then, if need be, on the whole map."""

    planner: str
    settings: Settings
    deadline: float
    cancel: pf.CancelToken

    def run(self, prepared: Prepared) -> _Found:
        """Find a path.

        Raises:
            Cancelled: The search was cancelled.
            OutOfTime: The time was too short.
            NoValidPath: There is no path.
            PlanformerError: The region cannot be proposed, and there is no fallback.
        """
        problem, guide = prepared.problem, self.settings.guide_name
        if self.planner in learned_planner_names(problem.robot) or not problem.is_connected:
            guide = None  # it plans by itself, or there is no way that a region could show
        if guide is None:
            return _Found(self._plan(prepared, None, share=1.0), prepared.costmap)
        try:
            return self._in_region(prepared, guide)
        except Cancelled:
            raise
        except PlanformerError as error:
            if not self.settings.fallback:
                raise
            result = self._plan(prepared, None, share=1.0)
            return _Found(result, prepared.costmap, fallback=str(error))

    def _in_region(self, prepared: Prepared, guide: str) -> _Found:
        region = propose(prepared, guide, self.settings)
        share = self.settings.guided_share if self.settings.fallback else 1.0
        return _Found(self._plan(prepared, region, share), prepared.costmap, region)

    def _plan(self, prepared: Prepared, region: pf.Region | None, share: float) -> pf.PlanResult:
        problem, settings = prepared.problem, self.settings
        if self.cancel.is_cancelled:
            raise error_of(pf.PlanStatus.CANCELLED)
        seconds = share * (self.deadline - time.perf_counter())
        if seconds < _SHORTEST_SEARCH:
            raise OutOfTime(
                f"no path was found within {settings.time_limit:g} s, the proposal included"
            )
        result = pf.plan(
            problem.grid,
            problem.robot,
            problem.start,
            problem.goal,
            planner=self.planner,
            guide=None if region is None else _Known(region),
            exploration=0.0 if region is None else settings.exploration,
            time_limit=seconds,
            max_vertices=settings.max_vertices or None,
            seed=settings.optional_seed,
            cancel=self.cancel,
        )
        # What an optimising planner had when it was cancelled is a path, but nobody wants it.
        if result.status is pf.PlanStatus.CANCELLED or not result.solved:
            raise error_of(result.status)
        return result


@dataclass(frozen=True)
class _Known:
    """A proposer whose region is there already."""

    region: pf.Region

    def propose(self, problem: pf.Problem) -> pf.Region:
        """The region."""
        del problem
        return self.region
