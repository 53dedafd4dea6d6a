"""MPNet: a network steps from start and goal towards each other, RRT* repairs what it cannot.

Qureshi, Miao, Simeonov and Yip, Motion Planning Networks, T-RO 2020, with the numbers of the
variant that *Motion Planning Transformers* (Johnson et al.) compares with.
"""

from __future__ import annotations

import dataclasses
import math
import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from numbers import Integral
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from planformer import _core
from planformer.baselines.mpnet_network import MPNetNetwork
from planformer.errors import InvalidParameter, UnknownPlanner
from planformer.geometry import polyline_length
from planformer.planning import (
    CancelToken,
    PlanResult,
    PlanStatus,
    Problem,
    SearchLimits,
    path_is_valid,
    search,
)
from planformer.planning.search import checked_seed

_States: TypeAlias = NDArray[np.float64]
"""(N, 2) or (2,) in metres, in the world frame: start and goal stay what the caller gave."""


@dataclass(frozen=True)
class MPNetPlanner:
    """The planner, for a point robot.

    Attributes:
        network: From `load_mpnet`.
        steps: Predictions, from both ends in turn, that join two states.
        replans: Rounds in which the network replaces the segments in collision.
        repair_seconds: Time for RRT* on each segment that is in collision after that, 0 for the
            network alone. Published were 20 x 0.25 s.
        restarts: Attempts.

    Raises:
        InvalidParameter: A value is out of range.
    """

    network: MPNetNetwork
    steps: int = 10
    replans: int = 10
    repair_seconds: float = 5.0
    restarts: int = 50

    def __post_init__(self) -> None:
        for name, least in (("steps", 1), ("replans", 0), ("restarts", 1)):
            value = getattr(self, name)
            if not (isinstance(value, Integral) and int(value) >= least):
                raise InvalidParameter(f"{name} must be an integer >= {least}; got {value}")
        if not (math.isfinite(self.repair_seconds) and self.repair_seconds >= 0):
            raise InvalidParameter(
                f"repair_seconds must be finite and >= 0; got {self.repair_seconds}"
            )

    def search(
        self,
        problem: Problem,
        *,
        limits: SearchLimits | None = None,
        seed: int | None = None,
        cancel: CancelToken | None = None,
    ) -> PlanResult:
        """Plan a path.

        Args:
            problem: A problem of a point robot.
            limits: When to stop; five seconds by default. Without a target length the first path
                ends the search.
            seed: 0 to 2**32 - 1; the same seed gives the same result unless a time limit ends the
                search or a repair. None draws one.
            cancel: Ends the search when cancelled from another thread.

        Returns:
            The result; its path has passed `path_is_valid`. Its vertices are the collision-free
            states that the network predicted and those of RRT*'s trees; its planning time
            includes the network's.

        Raises:
            UnknownPlanner: The robot is no point robot.
            InvalidParameter: The seed is out of range.
            InvalidWeights: The network does not do what its card says.
        """
        if problem.robot.state_dimension != 2:
            raise UnknownPlanner(
                f"MPNet plans for a PointRobot; got a {type(problem.robot).__name__}"
            )
        return _Query(self, problem, limits or SearchLimits(), seed, cancel).answer()


class _Stop(Exception):  # no error: it ends the search from any depth
    def __init__(self, status: PlanStatus) -> None:
        super().__init__(status)
        self.status = status


class _Query:
    """One call of `MPNetPlanner.search`."""

    def __init__(
        self,
        planner: MPNetPlanner,
        problem: Problem,
        limits: SearchLimits,
        seed: int | None,
        cancel: CancelToken | None,
    ) -> None:
        self.started = time.perf_counter()
        self.planner, self.problem, self.limits = planner, problem, limits
        self.cancel = cancel
        self.rng = np.random.default_rng(checked_seed(seed))
        self.vertices = 0
        self.best, self.best_length = np.empty((0, 2)), math.inf

    def answer(self) -> PlanResult:
        try:
            status = self._status()
        except _Stop as stop:
            status = stop.status
        return PlanResult(
            problem=self.problem,
            solved=len(self.best) > 0,
            status=status,
            path=self.best,
            length=self.best_length,
            vertices=self.vertices,
            planning_seconds=time.perf_counter() - self.started,
        )

    @cached_property
    def latent(self) -> NDArray[np.float32]:
        """The map's encoding; a query with a clear view never asks for it."""
        return self.planner.network.encode(self.problem)

    def _status(self) -> PlanStatus:
        """Plan; why it ended where no limit did."""
        if not self.problem.is_connected:
            return PlanStatus.UNREACHABLE
        self._check_limits()
        target = self.limits.target_length
        for _ in range(self.planner.restarts):
            self._keep(self._attempt())
            if target is not None and self.best_length <= target:
                return PlanStatus.TARGET_REACHED
            if target is None and len(self.best):
                break
        return PlanStatus.FINISHED

    def _keep(self, path: _States) -> None:
        length = polyline_length(path)
        problem = self.problem
        if length < self.best_length and path_is_valid(problem.grid, problem.robot, path):
            self.best, self.best_length = path, length

    def _attempt(self) -> _States:
        """A path, which may be in collision still."""
        start, goal = np.array(self.problem.start), np.array(self.problem.goal)
        path = self._contracted(self._grown(start, goal))
        for _ in range(self.planner.replans):
            path = self._contracted(self._mended(path, self._grown))
        return self._contracted(self._mended(path, self._searched))

    def _mended(self, path: _States, plan: Callable[[_States, _States], _States | None]) -> _States:
        """Replace each segment in collision by a plan between its ends.

        Where there is none the path remains as it is: the attempt has failed.
        """
        pieces = []
        for start, goal in pairwise(path):
            piece = np.array((start, goal)) if self._is_free(start, goal) else plan(start, goal)
            if piece is None:
                return path
            pieces.append(piece[:-1])
        return np.concatenate([*pieces, path[-1:]])

    def _grown(self, start: _States, goal: _States) -> _States:
        """Let the network step from both ends in turn until one sees the other."""
        ends = [[start], [goal]]
        for step in range(self.planner.steps):
            own, other = ends[step % 2], ends[1 - step % 2]
            if self._is_free(own[-1], other[-1]):
                break
            state = self._predicted(own[-1], other[-1])
            if self._is_free(state, state):
                own.append(state)
                self.vertices += 1
        return np.array(ends[0] + ends[1][::-1])

    def _predicted(self, current: _States, goal: _States) -> _States:
        self._check_limits()
        grid = self.problem.grid
        extent = np.array((grid.width, grid.height))
        ends = 2.0 * grid.frame.to_local([current, goal]) / extent - 1.0
        waypoint = self.planner.network.next_waypoint(self.latent, ends[0], ends[1], self.rng)
        return grid.frame.to_world(0.5 * (waypoint + 1.0) * extent)

    def _searched(self, start: _States, goal: _States) -> _States | None:
        """Let RRT* find any path; None where it does not."""
        if not self.planner.repair_seconds:
            return None
        self._check_limits()
        result = search(
            dataclasses.replace(self.problem, start=tuple(start), goal=tuple(goal)),
            "RRTstar",
            limits=self._remaining_limits(),
            seed=int(self.rng.integers(2**32)),
            cancel=self.cancel,
        )
        self.vertices += result.vertices
        return result.path if result.solved else None

    def _remaining_limits(self) -> SearchLimits:
        """Limits of a repair: what is left of the search's own, and the first path will do."""
        seconds, most = self.planner.repair_seconds, self.limits.max_vertices
        if self.limits.seconds is not None:
            passed = time.perf_counter() - self.started
            seconds = max(min(seconds, self.limits.seconds - passed), 1e-6)
        return SearchLimits(seconds, math.inf, most and most - self.vertices)

    def _contracted(self, path: _States) -> _States:
        """Join each state to the last one that it sees, and leave out those between.

        The paper's lazy states contraction.
        """
        kept, last = [0], len(path) - 1
        while (at := kept[-1]) < last:
            later = range(last, at + 1, -1)
            kept.append(next((j for j in later if self._is_free(path[at], path[j])), at + 1))
        return path[kept]

    def _is_free(self, start: _States, goal: _States) -> bool:
        """Whether no cell that a segment touches is blocked."""
        grid = self.problem.grid
        ends = grid.frame.to_local([start, goal])
        return _core.segment_is_free(self.problem.blocked, grid.resolution, *ends.ravel())

    def _check_limits(self) -> None:
        limits = self.limits
        if self.cancel is not None and self.cancel.is_cancelled:
            raise _Stop(PlanStatus.CANCELLED)
        if limits.seconds is not None and time.perf_counter() - self.started >= limits.seconds:
            raise _Stop(PlanStatus.TIME_LIMIT)
        if limits.max_vertices is not None and self.vertices >= limits.max_vertices:
            raise _Stop(PlanStatus.VERTEX_LIMIT)
