"""The search tree of NEXT, rewired as RRT*'s."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

_Point: TypeAlias = NDArray[np.float64]
"""(2,) in metres."""


class SearchTree:
    """A tree of states in the plane, each joined to the root as cheaply as its neighbours allow.

    Karaman and Frazzoli, Sampling-based Algorithms for Optimal Motion Planning, IJRR 2011.

    Args:
        root: (2,) first state.
        capacity: States that the tree may hold.
        radius: How far away in metres neighbours are.
        is_free: Whether the segment between two states is free of collision.
    """

    def __init__(
        self, root: _Point, capacity: int, radius: float, is_free: Callable[[_Point, _Point], bool]
    ) -> None:
        self._radius, self._is_free = radius, is_free
        self._states, self._costs = np.empty((capacity, 2)), np.zeros(capacity)
        self._parents = np.full(capacity, -1)
        self._children: list[list[int]] = [[]]
        self._states[0] = root

    def __len__(self) -> int:
        return len(self._children)

    @property
    def states(self) -> NDArray[np.float64]:
        """(V, 2) states, the root first."""
        return self._states[: len(self)]

    @property
    def costs(self) -> NDArray[np.float64]:
        """(V,) lengths in metres of the ways from the root."""
        return self._costs[: len(self)]

    @property
    def edges(self) -> NDArray[np.int64]:
        """(V - 1, 2) indices (parent, child)."""
        children = np.arange(1, len(self))
        return np.column_stack((self._parents[children], children)).astype(np.int64)

    def nearest(self, point: _Point) -> int:
        """Index of the state closest to a point."""
        return int(self._distances(point).argmin())

    def extend(self, parent: int, state: _Point) -> int | None:
        """Add a state; None where the segment from the parent to it is not free.

        The state takes the parent that makes it the cheapest, and becomes the parent of those
        neighbours that it makes cheaper.
        """
        if not self._is_free(self.states[parent], state):
            return None
        distances = self._distances(state)
        near = np.flatnonzero(distances <= self._radius)
        new = self._append(state)
        ways = self._costs[near] + distances[near]
        for j in near[ways.argsort(kind="stable")].tolist():
            if j == parent or self._is_free(self._states[j], state):
                parent = j
                break
        self._link(parent, new, float(distances[parent]))
        for j in near[self._costs[new] + distances[near] < self._costs[near]].tolist():
            # An earlier neighbour may have made this one cheaper since.
            cheaper = self._costs[new] + distances[j] < self._costs[j]
            if cheaper and self._is_free(state, self._states[j]):
                self._children[self._parents[j]].remove(j)
                self._link(new, j, float(distances[j]))
        return new

    def path_to(self, index: int) -> NDArray[np.float64]:
        """(N, 2) states from the root to a state."""
        indices = [index]
        while (parent := int(self._parents[indices[-1]])) >= 0:
            indices.append(parent)
        return self._states[indices[::-1]]

    def _distances(self, point: _Point) -> NDArray[np.float64]:
        offsets = self.states - point
        return np.hypot(offsets[:, 0], offsets[:, 1])

    def _append(self, state: _Point) -> int:
        self._states[len(self)] = state
        self._children.append([])
        return len(self) - 1

    def _link(self, parent: int, child: int, distance: float) -> None:
        """Make a state another's child, and bring the costs behind it up to date."""
        self._parents[child] = parent
        self._children[parent].append(child)
        saved = self._costs[child] - (self._costs[parent] + distance)
        self._costs[list(self._with_descendants(child))] -= saved

    def _with_descendants(self, index: int) -> Iterator[int]:
        pending = [index]
        while pending:
            yield (last := pending.pop())
            pending += self._children[last]
