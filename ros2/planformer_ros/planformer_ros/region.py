"""Answers requests for a region."""

from __future__ import annotations

import time
from dataclasses import dataclass

import numpy as np
import planformer as pf
from numpy.typing import NDArray
from planformer.errors import PlanformerError
from planformer.maps import Costmap
from planformer.maps.costmap import fallback_reason

from planformer_ros.error_codes import ErrorCode, NoValidPath, code_of
from planformer_ros.problem import Pose, Prepared, prepare
from planformer_ros.settings import Settings
from planformer_ros.world import Snapshot


@dataclass(frozen=True)
class RegionAnswer:
    """The answer to a request for a region.

    Attributes:
        mask: (H, W) bool, true inside the region; None if there is none.
        seconds: Time that it took.
        code: NONE, or why there is no region.
        message: The same in words.
    """

    mask: NDArray[np.bool_] | None
    seconds: float
    code: ErrorCode = ErrorCode.NONE
    message: str = ""


def answer_region(
    costmap: Costmap, start: Pose, goal: Pose, guide: str, settings: Settings
) -> RegionAnswer:
    """Propose a region.

    Args:
        costmap: A costmap, inflated but for the settings' `costmap_radius`.
        start: Pose in the frame of the costmap.
        goal: As the start.
        guide: Name of weights; empty for those of the settings.
        settings: The settings. Without weights of their own those are used that suit the robot.
    """
    started = time.perf_counter()
    name = guide or settings.guide_name or settings.recommended_guide
    try:
        prepared = prepare(Snapshot(costmap, is_inflated=True), start, goal, settings)
        mask = propose(prepared, name, settings).mask
    except PlanformerError as error:
        return RegionAnswer(None, time.perf_counter() - started, code_of(error), str(error))
    return RegionAnswer(mask, time.perf_counter() - started)


def propose(prepared: Prepared, guide: str, settings: Settings) -> pf.Region:
    """Propose a region that connects start and goal.

    Raises:
        UnknownGuide: No such weights.
        InvalidWeights: They are damaged or do not suit the robot.
        NoValidPath: Start and goal are not connected in the region that they propose.
    """
    problem = prepared.problem
    region = pf.propose_region(
        problem.grid,
        problem.robot,
        problem.start,
        problem.goal,
        guide=guide,
        threshold=settings.optional_threshold,
    )
    reason = fallback_reason(prepared.costmap, region.mask, problem.start, problem.goal)
    if reason is not None:
        raise NoValidPath(reason)
    return region
