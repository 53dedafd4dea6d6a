"""Planning: problems, OMPL's planners on them, results and their check."""

from planformer.planning.edges import edge_lines
from planformer.planning.problem import Problem
from planformer.planning.progress import Progress, Snapshot
from planformer.planning.result import PlanResult, PlanStatus, Tree
from planformer.planning.sampling import REFINEMENT, REFINEMENT_IN_REGION, SamplingRegion
from planformer.planning.search import (
    CancelToken,
    SearchLimits,
    is_connected,
    planner_names,
    search,
)
from planformer.planning.validity import path_is_valid

__all__ = [
    "REFINEMENT",
    "REFINEMENT_IN_REGION",
    "CancelToken",
    "PlanResult",
    "PlanStatus",
    "Problem",
    "Progress",
    "SamplingRegion",
    "SearchLimits",
    "Snapshot",
    "Tree",
    "edge_lines",
    "is_connected",
    "path_is_valid",
    "planner_names",
    "search",
]
