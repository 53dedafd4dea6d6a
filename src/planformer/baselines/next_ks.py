"""NEXT-KS: a tree search that a network's policy and values lead.

Chen, Dai, Lin, Ye, Liu and Song, Learning to Plan in High Dimensions via Neural
Exploration-Exploitation Trees, ICLR 2020, with the upper confidence bound whose counts are
smoothed by a kernel.
"""

from __future__ import annotations

import math
import time
from dataclasses import dataclass
from functools import cached_property
from numbers import Integral
from typing import Any

import numpy as np
from numpy.typing import NDArray

from planformer import _core
from planformer.baselines.next_map import free_parts, normalised, square_side
from planformer.baselines.next_network import NextEvaluator
from planformer.baselines.next_tree import SearchTree
from planformer.baselines.next_visits import SmoothedVisits
from planformer.errors import InvalidParameter, UnknownPlanner
from planformer.geometry import polyline_length
from planformer.planning import (
    CancelToken,
    PlanResult,
    PlanStatus,
    Problem,
    SearchLimits,
    Tree,
    path_is_valid,
)
from planformer.planning.search import checked_seed

STEP = 0.05
"""Length of a step, and how near a state sees the goal: coordinates go from -1 to 1."""
DEVIATION = 0.3
"""Standard deviation of the policy along each axis, in steps."""
_GOAL_BIAS = 0.05
_CANDIDATES = 10
_NEIGHBOURS = 3.0
"""Radius in steps within which the tree is rewired."""
_AT_ONCE = 32
"""States that are evaluated together: each takes the memory of some copies of the map."""


@dataclass(frozen=True)
class NextPlanner:
    """The planner, for a point robot.

    Attributes:
        network: From `load_next`.
        samples: Samples T after which it gives up, those in collision included.
        exploration: Probability epsilon of a sample of RRT's.
        uncertainty: Weight c of the uncertainty in the confidence bound.

    Raises:
        InvalidParameter: A value is out of range.
    """

    network: NextEvaluator
    samples: int = 500
    exploration: float = 0.1
    uncertainty: float = 1.0

    def __post_init__(self) -> None:
        if not (isinstance(self.samples, Integral) and self.samples >= 1):
            raise InvalidParameter(f"samples must be an integer >= 1; got {self.samples}")
        if not 0.0 <= self.exploration <= 1.0:
            raise InvalidParameter(f"exploration must be between 0 and 1; got {self.exploration}")
        if not (math.isfinite(self.uncertainty) and self.uncertainty >= 0.0):
            raise InvalidParameter(f"uncertainty must be finite and >= 0; got {self.uncertainty}")

    def search(
        self,
        problem: Problem,
        *,
        limits: SearchLimits | None = None,
        seed: int | None = None,
        keep_tree: bool = False,
        cancel: CancelToken | None = None,
    ) -> PlanResult:
        """Plan a path.

        Args:
            problem: A problem of a point robot.
            limits: When to stop; five seconds by default. Without a target length the first path
                ends the search.
            seed: 0 to 2**32 - 1; the same seed gives the same result unless the time limit ends
                the search. None draws one.
            keep_tree: Return the search tree.
            cancel: Ends the search when cancelled from another thread.

        Returns:
            The result; its path has passed `path_is_valid`. Its planning time includes the
            network's.

        Raises:
            UnknownPlanner: The robot is no point robot.
            InvalidParameter: The seed is out of range.
            InvalidWeights: The network does not do what its card says.
        """
        if problem.robot.state_dimension != 2:
            raise UnknownPlanner(
                f"NEXT-KS plans for a PointRobot; got a {type(problem.robot).__name__}"
            )
        query = _Query(self, problem, limits or SearchLimits(), seed, cancel)
        return query.answer(keep_tree=keep_tree)


class _Query:
    """One call of `NextPlanner.search`; its states are metres in the map's own frame."""

    def __init__(
        self,
        planner: NextPlanner,
        problem: Problem,
        limits: SearchLimits,
        seed: int | None,
        cancel: CancelToken | None,
    ) -> None:
        self.started = time.perf_counter()
        self.planner, self.problem, self.limits = planner, problem, limits
        self.cancel = cancel
        self.rng = np.random.default_rng(checked_seed(seed))
        self.goal = problem.local_goal[:2]
        self.side = square_side(problem.blocked, problem.grid.resolution)
        self.step = 0.5 * STEP * self.side
        capacity = planner.samples + 2
        radius = _NEIGHBOURS * self.step
        self.tree = SearchTree(problem.local_start[:2], capacity, radius, self._is_free)
        self.reached: int | None = None
        self.means, self.values = np.empty((capacity, 2)), np.full(capacity, np.nan)
        self.visits = SmoothedVisits(capacity, self.step)
        self.visit_of = np.empty(capacity, np.intp)
        self.visit_of[0] = self.visits.note(self.tree.states[0])

    def answer(self, *, keep_tree: bool) -> PlanResult:
        status = self._status()
        path = self._path()
        problem, frame = self.problem, self.problem.grid.frame
        if len(path) and not path_is_valid(problem.grid, problem.robot, path):
            path, status = path[:0], PlanStatus.INVALID_PATH
        seconds = time.perf_counter() - self.started
        return PlanResult(
            problem=problem,
            solved=len(path) > 0,
            status=status,
            path=path,
            length=polyline_length(path) if len(path) else math.inf,
            vertices=len(self.tree),
            planning_seconds=seconds,
            tree=Tree(frame.to_world(self.tree.states), self.tree.edges) if keep_tree else None,
        )

    def _path(self) -> NDArray[np.float64]:
        if self.reached is None:
            return np.empty((0, 2))
        path = self.problem.grid.frame.to_world(self.tree.path_to(self.reached))
        # The rounding of the frame's rotation must not move what the caller gave.
        path[0], path[-1] = self.problem.start, self.problem.goal
        return path

    def _status(self) -> PlanStatus:
        """Grow the tree; why that ended."""
        if not self.problem.is_connected:
            return PlanStatus.UNREACHABLE
        self._look_for_goal(0)
        if self.reached is not None:  # nothing is shorter than a straight line
            return self._end() or PlanStatus.FINISHED
        for _ in range(self.planner.samples):
            if (status := self._end()) is not None:
                return status
            self._sample()
        return self._end() or PlanStatus.FINISHED

    @cached_property
    def context(self) -> Any:
        """What the network has planned; RRT's samples alone need none."""
        free = free_parts(self.problem.blocked, self.planner.network.side)
        return self.planner.network.plan(free, normalised(self.goal, self.side))

    def _end(self) -> PlanStatus | None:
        """Why the search is over, None where it is not."""
        limits = self.limits
        if self.reached is not None:
            if limits.target_length is None:
                return PlanStatus.FINISHED
            if self.tree.costs[self.reached] <= limits.target_length:
                return PlanStatus.TARGET_REACHED
        if self.cancel is not None and self.cancel.is_cancelled:
            return PlanStatus.CANCELLED
        if limits.seconds is not None and time.perf_counter() - self.started >= limits.seconds:
            return PlanStatus.TIME_LIMIT
        if limits.max_vertices is not None and len(self.tree) >= limits.max_vertices:
            return PlanStatus.VERTEX_LIMIT
        return None

    def _sample(self) -> None:
        goal_bias = _GOAL_BIAS if self.reached is None else 0.0
        if self.rng.random() < goal_bias:
            self._step_towards(self.goal)
        elif self.rng.random() < self.planner.exploration:
            grid = self.problem.grid
            self._step_towards(self.rng.random(2) * (grid.width, grid.height))
        else:
            self._follow_policy()

    def _step_towards(self, point: NDArray[np.float64]) -> None:
        """A step of RRT: from the nearest state."""
        parent = self.tree.nearest(point)
        way = (point - self.tree.states[parent]) / self.step
        self._add(parent, self.tree.states[parent] + self.step * _cut(way))

    def _follow_policy(self) -> None:
        """Choose a state, some steps from it and the best of them, by their confidence bounds."""
        self._evaluate_new()
        states, counts = self.tree.states, self._counts()
        parent = int(self._bounds(self.values[: len(states)], counts).argmax())
        noise = DEVIATION * self.rng.standard_normal((_CANDIDATES, 2))
        candidates = states[parent] + self.step * _cut(self.means[parent] + noise)
        means, values = self._evaluate(candidates)
        best = int(self._bounds(values, self.visits.at(candidates)).argmax())
        new = self._add(parent, candidates[best])
        if new is not None:
            self.means[new], self.values[new] = means[best], values[best]

    def _bounds(
        self, values: NDArray[np.float64], counts: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Upper confidence bounds of states."""
        total = math.log(self._counts().sum())
        return np.asarray(values + self.planner.uncertainty * np.sqrt(total / counts))

    def _counts(self) -> NDArray[np.float64]:
        """(V,) smoothed numbers of visits of the tree's states."""
        return self.visits.counts[self.visit_of[: len(self.tree)]]

    def _evaluate_new(self) -> None:
        """Evaluate the states that have not been."""
        new = np.flatnonzero(np.isnan(self.values[: len(self.tree)]))
        for first in range(0, len(new), _AT_ONCE):
            some = new[first : first + _AT_ONCE]
            self.means[some], self.values[some] = self._evaluate(self.tree.states[some])

    def _evaluate(
        self, states: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        return self.planner.network.evaluate(self.context, normalised(states, self.side))

    def _add(self, parent: int, state: NDArray[np.float64]) -> int | None:
        """Add a state to the tree if it can be, and join it to the goal if that is near."""
        new = self.tree.extend(parent, state)
        # One in collision counts too: it would be chosen for ever otherwise.
        visit = self.visits.note(state)
        if new is not None:
            self.visit_of[new] = visit
            self._look_for_goal(new)
        return new

    def _look_for_goal(self, index: int) -> None:
        if self.reached is not None or math.dist(self.tree.states[index], self.goal) > self.step:
            return
        self.reached = self.tree.extend(index, self.goal)
        if self.reached is not None:
            self.visit_of[self.reached] = self.visits.note(self.goal)

    def _is_free(self, start: NDArray[np.float64], end: NDArray[np.float64]) -> bool:
        """Whether no cell that a segment touches is blocked."""
        grid = self.problem.grid
        return _core.segment_is_free(self.problem.blocked, grid.resolution, *start, *end)


def _cut(steps: NDArray[np.float64]) -> NDArray[np.float64]:
    """(..., 2) vectors cut to a length of 1."""
    lengths = np.linalg.norm(steps, axis=-1, keepdims=True)
    return np.asarray(steps / np.maximum(lengths, 1.0))
