"""Error codes of Nav2 and the errors of planformer that they stand for."""

from __future__ import annotations

from enum import IntEnum

from planformer import PlanStatus
from planformer.errors import (
    GoalOccupied,
    GoalOutsideMap,
    InvalidWeights,
    PlanformerError,
    StartOccupied,
    StartOutsideMap,
    UnknownGuide,
    UnknownPlanner,
)


class ErrorCode(IntEnum):
    """Error codes of nav2_msgs/action/ComputePathToPose."""

    NONE = 0
    UNKNOWN = 200
    INVALID_PLANNER = 201
    TF_ERROR = 202
    START_OUTSIDE_MAP = 203
    GOAL_OUTSIDE_MAP = 204
    START_OCCUPIED = 205
    GOAL_OCCUPIED = 206
    TIMEOUT = 207
    NO_VALID_PATH = 208


class TransformUnavailable(PlanformerError):
    """A pose cannot be brought into the map's frame, or the robot's pose is not known."""


class OutOfTime(PlanformerError):
    """Nothing was found in the time that there is."""


class NoValidPath(PlanformerError):
    """There is no path, or the planner gave up."""


class Cancelled(PlanformerError):
    """Nobody wants the answer any more. Has no code: Nav2's action has a status for it."""


# The first row that an error is an instance of counts.
_CODES: tuple[tuple[type[PlanformerError], ErrorCode], ...] = (
    (StartOutsideMap, ErrorCode.START_OUTSIDE_MAP),
    (GoalOutsideMap, ErrorCode.GOAL_OUTSIDE_MAP),
    (StartOccupied, ErrorCode.START_OCCUPIED),
    (GoalOccupied, ErrorCode.GOAL_OCCUPIED),
    (UnknownPlanner, ErrorCode.INVALID_PLANNER),
    (UnknownGuide, ErrorCode.INVALID_PLANNER),
    (InvalidWeights, ErrorCode.INVALID_PLANNER),
    (TransformUnavailable, ErrorCode.TF_ERROR),
    (OutOfTime, ErrorCode.TIMEOUT),
    (NoValidPath, ErrorCode.NO_VALID_PATH),
    (PlanformerError, ErrorCode.UNKNOWN),
)


def code_of(error: PlanformerError) -> ErrorCode:
    """The code of an error."""
    return next(code for kind, code in _CODES if isinstance(error, kind))


def error_of(status: PlanStatus) -> PlanformerError:
    """The error that a search without a path ended with."""
    if status is PlanStatus.CANCELLED:
        return Cancelled("the plan was cancelled")
    if status is PlanStatus.TIME_LIMIT:
        return OutOfTime("no path was found within the time limit")
    if status is PlanStatus.UNREACHABLE:
        return NoValidPath("obstacles separate start and goal")
    return NoValidPath(f"the planner found no path ({status.value})")
