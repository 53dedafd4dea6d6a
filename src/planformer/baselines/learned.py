"""Learned planners by name: each plans with shipped weights of its own instead of a region."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Protocol

from planformer.baselines.mpnet import MPNetPlanner
from planformer.baselines.mpnet_network import load_mpnet
from planformer.baselines.next_ks import NextPlanner
from planformer.baselines.next_network import load_next
from planformer.errors import UnknownPlanner
from planformer.planning import CancelToken, PlanResult, Problem, SearchLimits
from planformer.robots import PointRobot, Robot
from planformer.weights import SHIPPED, Weights, read_weights


class LearnedPlanner(Protocol):
    """A planner whose network is its own."""

    def search(
        self,
        problem: Problem,
        *,
        limits: SearchLimits | None = None,
        seed: int | None = None,
        cancel: CancelToken | None = None,
    ) -> PlanResult:
        """Plan a path; arguments as those of `planformer.planning.search`."""
        ...


_PLANNERS: dict[str, tuple[str, Callable[[str], LearnedPlanner]]] = {
    "MPNet": ("mpnet.forest_maze_indoor", lambda path: MPNetPlanner(load_mpnet(path))),
    "NEXT-KS": ("next_ks.forest_maze", lambda path: NextPlanner(load_next(path))),
}
"""Name of the weights and what makes the planner of their file."""


def learned_planner_names(robot: Robot) -> list[str]:
    """Names of the learned planners for a robot."""
    return list(_PLANNERS) if isinstance(robot, PointRobot) else []


def load_planner(name: str) -> LearnedPlanner:
    """A learned planner by name; its weights are loaded once.

    Raises:
        UnknownPlanner: No learned planner has the name.
        InvalidWeights: Its weights are missing or damaged.
    """
    if name not in _PLANNERS:
        raise UnknownPlanner(f"unknown learned planner {name!r}; valid: {', '.join(_PLANNERS)}")
    return _PLANNERS[name][1](str(_file(name)))


def planner_weights(name: str) -> Weights:
    """Weights of a learned planner by name.

    Raises:
        InvalidWeights: They are missing or damaged.
    """
    return read_weights(_file(name))


def _file(name: str) -> Path:
    return SHIPPED / "planners" / f"{_PLANNERS[name][0]}.onnx"
