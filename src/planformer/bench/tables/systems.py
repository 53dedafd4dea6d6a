"""What the tables compare: planners with and without guidance, and searches on the grid."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Mapping
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from planformer.baselines import load_planner, planner_weights
from planformer.bench.guides import LazyThetaProposer
from planformer.data.experts import HybridAstarExpert, LazyThetaExpert, astar_path
from planformer.geometry import polyline_length
from planformer.guidance import RegionProposer, load_network
from planformer.guidance.onnx import OnnxProposer
from planformer.guidance.region import PAPER_THRESHOLD
from planformer.planning import (
    REFINEMENT,
    REFINEMENT_IN_REGION,
    PlanResult,
    PlanStatus,
    Problem,
    SearchLimits,
    path_is_valid,
    search,
)
from planformer.weights import Weights

CORRIDOR = "lazy-theta corridor"
"""A guide without learning: the surroundings of the shortest any-angle path."""


@dataclass(frozen=True, eq=False)
class Solution:
    """What a system found.

    Attributes:
        path: (N, 2) or (N, 3) in the world frame, None without one.
        length: Its length in metres, infinite without one.
        vertices: Collision-free states in the search tree; 0 for a search on the grid.
        proposal_seconds: Time of the region proposal.
        planning_seconds: Time of the search.
        status: Why the search ended.
    """

    path: NDArray[np.float64] | None
    length: float
    vertices: int
    proposal_seconds: float
    planning_seconds: float
    status: str


def _solution(result: PlanResult, proposal_seconds: float) -> Solution:
    return Solution(
        path=result.path if result.solved else None,
        length=result.length,
        vertices=result.vertices,
        proposal_seconds=proposal_seconds,
        planning_seconds=result.planning_seconds,
        status=result.status.value,
    )


@dataclass(frozen=True)
class GuidedPlanner:
    """One of OMPL's planners, with or without a guide.

    Attributes:
        planner: OMPL class name.
        guide: `CORRIDOR`, the name of shipped weights, or None.
        threshold: As in `OnnxProposer`; by default the one that connects start and goal.
        exploration: Share of the samples drawn from the whole map.
        refinement: Share of the samples near the best path so far.
    """

    planner: str
    guide: str | None = None
    threshold: float | None = None
    exploration: float = 0.0
    refinement: float = REFINEMENT_IN_REGION

    def solve(self, problem: Problem, limits: SearchLimits, seed: int) -> Solution:
        """Propose a region if there is a guide, and search."""
        proposer = None if self.guide is None else self._proposer()  # loads the weights once
        started = time.perf_counter()
        region = None if proposer is None else proposer.propose(problem).sampling()
        seconds = 0.0 if proposer is None else time.perf_counter() - started
        result = search(
            problem,
            self.planner,
            region=region,
            exploration=self.exploration,
            refinement=self.refinement,
            limits=limits,
            seed=seed,
        )
        return _solution(result, seconds)

    def _proposer(self) -> RegionProposer:
        assert self.guide is not None
        if self.guide == CORRIDOR:
            return LazyThetaProposer()
        return OnnxProposer(load_network(self.guide), self.threshold)


@dataclass(frozen=True)
class LearnedSystem:
    """A planner with a network of its own.

    Attributes:
        planner: Its name, see `planformer.baselines`.
    """

    planner: str

    def solve(self, problem: Problem, limits: SearchLimits, seed: int) -> Solution:
        """Plan; its time includes the network's."""
        return _solution(load_planner(self.planner).search(problem, limits=limits, seed=seed), 0.0)


Solve = Callable[[Problem, int], NDArray[np.float64] | None]


@dataclass(frozen=True)
class GridSearch:
    """A search on the grid, which ends by itself with the one path that it finds.

    Attributes:
        find: Gives a path of a problem, and takes a seed that it ignores.
    """

    find: Solve

    def solve(self, problem: Problem, limits: SearchLimits, seed: int) -> Solution:
        """Search to the end, and check the path as planners' paths are checked.

        What takes longer than the limit counts as no path.
        """
        started = time.perf_counter()
        path = self.find(problem, seed)
        status = "finished"
        if path is not None and not path_is_valid(problem.grid, problem.robot, path):
            path, status = None, "invalid path"
        seconds = time.perf_counter() - started
        if limits.seconds is not None and seconds > limits.seconds:
            path, status = None, PlanStatus.TIME_LIMIT.value
        return Solution(
            path=path,
            length=np.inf if path is None else polyline_length(path),
            vertices=0,
            proposal_seconds=0.0,
            planning_seconds=seconds,
            status=status,
        )


System = GuidedPlanner | LearnedSystem | GridSearch


def _astar(problem: Problem, seed: int) -> NDArray[np.float64] | None:
    del seed
    return astar_path(problem.grid, problem.robot.radius, problem.start, problem.goal)


_EE = 0.5
"""As many samples from the whole map as from the region: the paper alternates."""


def _plain(planner: str, guide: str | None = None) -> GuidedPlanner:
    return GuidedPlanner(planner, guide, refinement=0.0)


def _refined(planner: str) -> GuidedPlanner:
    return GuidedPlanner(planner, refinement=REFINEMENT)


POINT_SYSTEMS: dict[str, System] = {
    "RRT*": _plain("RRTstar"),
    "IRRT*": _plain("InformedRRTstar"),
    "BIT*": _plain("BITstar"),
    "ABIT*": _plain("ABITstar"),
    "AIT*": _plain("AITstar"),
    "RRT* (refined)": _refined("RRTstar"),
    "IRRT* (refined)": _refined("InformedRRTstar"),
    "BIT* (refined)": _refined("BITstar"),
    "UNet-RRT*": GuidedPlanner("RRTstar", "unet", PAPER_THRESHOLD),
    "UNet-RRT*-EE": GuidedPlanner("RRTstar", "unet", PAPER_THRESHOLD, _EE),
    "MPNet": LearnedSystem("MPNet"),
    "NEXT-KS": LearnedSystem("NEXT-KS"),
    "MPT-RRT* (F.E.)": GuidedPlanner("RRTstar", "mpt-paper-fixed-encoding", PAPER_THRESHOLD),
    "MPT-IRRT* (F.E.)": GuidedPlanner(
        "InformedRRTstar", "mpt-paper-fixed-encoding", PAPER_THRESHOLD
    ),
    "MPT-RRT* (S.E.)": GuidedPlanner("RRTstar", "mpt-paper", PAPER_THRESHOLD),
    "MPT-RRT* (not refined)": _plain("RRTstar", "mpt"),
    "MPT-RRT*": GuidedPlanner("RRTstar", "mpt"),
    "MPT-IRRT*": GuidedPlanner("InformedRRTstar", "mpt"),
    "MPT-BIT*": GuidedPlanner("BITstar", "mpt"),
    "MPT-RRT*-EE": GuidedPlanner("RRTstar", "mpt", exploration=_EE),
    "Corridor-RRT*": GuidedPlanner("RRTstar", CORRIDOR),
    "Corridor-BIT*": GuidedPlanner("BITstar", CORRIDOR),
    "A* + shortcut": GridSearch(_astar),
    "Lazy Theta*": GridSearch(LazyThetaExpert().solve),
}
"""The systems of the tables for point robots, by the paper's names.

F.E. and S.E. are the paper's architecture with fixed and shifted position encoding. All guided
planners refine their path, as `plan` does, but for the one that is called so.
"""

CAR_SYSTEMS: dict[str, System] = {
    "RRT*": _plain("RRTstar"),
    "IRRT*": _plain("InformedRRTstar"),
    "SST": _plain("SST"),
    "RRT* (refined)": _refined("RRTstar"),
    "IRRT* (refined)": _refined("InformedRRTstar"),
    "MPT-RRT* (not refined)": _plain("RRTstar", "mpt-dubins"),
    "MPT-RRT*": GuidedPlanner("RRTstar", "mpt-dubins"),
    "MPT-IRRT*": GuidedPlanner("InformedRRTstar", "mpt-dubins"),
    "MPT-RRT*-EE": GuidedPlanner("RRTstar", "mpt-dubins", exploration=_EE),
    "Corridor-RRT*": GuidedPlanner("RRTstar", CORRIDOR),
    "Hybrid-A*": GridSearch(HybridAstarExpert().solve),
}
"""The systems of the table for the car."""


def definitions(systems: Mapping[str, System]) -> dict[str, dict[str, Any]]:
    """What systems are made of, by their names; a search on the grid has no settings."""
    return {
        name: {} if isinstance(system, GridSearch) else asdict(system)
        for name, system in systems.items()
    }


def fingerprints(systems: Iterable[System]) -> dict[str, str]:
    """The SHA-256 of the weights that systems plan with."""
    weights: dict[str, Weights] = {}
    for system in systems:
        if isinstance(system, LearnedSystem):
            weights[system.planner] = planner_weights(system.planner)
        elif isinstance(system, GuidedPlanner) and system.guide not in (None, CORRIDOR):
            weights[system.guide] = load_network(system.guide).weights
    return {name: str(its.card["sha256"]) for name, its in sorted(weights.items())}
