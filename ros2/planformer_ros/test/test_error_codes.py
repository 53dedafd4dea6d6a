from __future__ import annotations

import pytest
from nav2_msgs.action import ComputePathToPose
from planformer import PlanStatus, errors
from planformer.errors import PlanformerError

from planformer_ros import error_codes
from planformer_ros.error_codes import ErrorCode, code_of, error_of


def subclasses(kind: type) -> set[type]:
    return {kind}.union(*(subclasses(other) for other in kind.__subclasses__()))


def test_every_error_has_a_code():
    for kind in subclasses(PlanformerError):
        assert code_of(kind.__new__(kind)) in ErrorCode
        assert code_of(kind.__new__(kind)) is not ErrorCode.NONE


@pytest.mark.parametrize(
    ("kind", "code"),
    [
        (errors.InvalidMap, 200),
        (errors.InvalidProblem, 200),
        (errors.UnknownPlanner, 201),
        (errors.UnknownGuide, 201),
        (errors.WeightsMismatch, 201),
        (error_codes.TransformUnavailable, 202),
        (errors.StartOutsideMap, 203),
        (errors.GoalOutsideMap, 204),
        (errors.StartOccupied, 205),
        (errors.GoalOccupied, 206),
        (error_codes.OutOfTime, 207),
        (error_codes.NoValidPath, 208),
    ],
)
def test_codes_are_nav2s(kind, code):
    assert code_of(kind("message")) == code


@pytest.mark.parametrize(
    ("status", "code"),
    [
        (PlanStatus.TIME_LIMIT, ErrorCode.TIMEOUT),
        (PlanStatus.UNREACHABLE, ErrorCode.NO_VALID_PATH),
        (PlanStatus.VERTEX_LIMIT, ErrorCode.NO_VALID_PATH),
        (PlanStatus.INVALID_PATH, ErrorCode.NO_VALID_PATH),
        (PlanStatus.FINISHED, ErrorCode.NO_VALID_PATH),
    ],
)
def test_a_search_without_a_path(status, code):
    assert code_of(error_of(status)) is code


def test_a_cancelled_search():
    assert isinstance(error_of(PlanStatus.CANCELLED), error_codes.Cancelled)


def test_the_stand_in_has_the_fields_of_nav2s_action():
    assert ComputePathToPose.Goal.get_fields_and_field_types() == {
        "goal": "geometry_msgs/PoseStamped",
        "start": "geometry_msgs/PoseStamped",
        "planner_id": "string",
        "use_start": "boolean",
    }
    assert ComputePathToPose.Result.get_fields_and_field_types() == {
        "path": "nav_msgs/Path",
        "planning_time": "builtin_interfaces/Duration",
        "error_code": "uint16",
        "error_msg": "string",
    }
