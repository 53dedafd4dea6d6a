"""Progress: what a search has found so far, to be read while it goes on."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from planformer import _core
from planformer.errors import InvalidParameter
from planformer.planning.problem import Problem
from planformer.planning.result import Tree


@dataclass(frozen=True, eq=False)
class Snapshot:
    """What a search had found at one moment.

    Attributes:
        seconds: Wall-clock seconds since the search began.
        length: Length of the best path in metres, infinite without one.
        path: (N, 2) or (N, 3) float64 states of the best path in the world frame, as in a
            `PlanResult`, but not checked a second time; empty without one.
        vertices: States in the search tree; without a tree, states that the planner holds, which
            are a few more.
        tree: The search tree if it was asked for.
    """

    seconds: float
    length: float
    path: NDArray[np.float64]
    vertices: int
    tree: Tree | None


class Progress:
    """Snapshots of one search at a time: pass it to `plan`, call `latest` from another thread.

    The planner's own thread takes them between two of its steps. AITstar, LazyPRMstar, SST and
    planners that end with their first path know of no path before; learned planners take no
    snapshots.

    Args:
        interval: Seconds from one snapshot to the next; more where snapshots of a large tree would
            take more than a tenth of the search's time.
        keep_tree: Whether snapshots have the search tree.

    Raises:
        InvalidParameter: The interval is not finite and positive.
    """

    def __init__(self, *, interval: float = 0.05, keep_tree: bool = False) -> None:
        if not (math.isfinite(interval) and interval > 0):
            raise InvalidParameter(f"interval must be finite and > 0 s; got {interval}")
        self._interval, self._keep_tree = interval, keep_tree
        self._search: tuple[_core.Progress, Problem] | None = None

    def begin(self, problem: Problem) -> _core.Progress:
        """Where the core puts the snapshots of a search for a problem."""
        record = _core.Progress(self._interval, self._keep_tree)
        self._search = record, problem
        return record

    def latest(self) -> Snapshot | None:
        """The last snapshot, None before the first; thread-safe."""
        if self._search is None:
            return None
        record, problem = self._search
        found = record.latest()
        if found is None:
            return None
        dimension, frame = problem.robot.state_dimension, problem.grid.frame
        tree = Tree.from_core(found, problem) if self._keep_tree else None
        return Snapshot(
            seconds=found.seconds,
            length=found.length,
            path=frame.to_world(found.path)[:, :dimension],
            vertices=found.states if tree is None else len(tree.vertices),
            tree=tree,
        )
