"""Kernel-smoothed numbers of visits, for confidence bounds in a continuous space."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


class SmoothedVisits:
    """How often the surroundings of states were visited.

    A visit of s' counts for a state s as exp(-(|s - s'| / radius)^2).

    Args:
        capacity: Visits that may be noted.
        radius: Radius of the kernel in metres.
    """

    def __init__(self, capacity: int, radius: float) -> None:
        self._radius, self._size = radius, 0
        self._states, self._counts = np.empty((capacity, 2)), np.empty(capacity)

    @property
    def counts(self) -> NDArray[np.float64]:
        """(M,) counts at the visited states, in the order of the visits."""
        return self._counts[: self._size]

    def note(self, state: NDArray[np.float64]) -> int:
        """Note a visit of a state (2,); returns its number."""
        nearby = self._kernel(state)
        self._counts[: self._size] += nearby
        self._states[self._size], self._counts[self._size] = state, 1.0 + nearby.sum()
        self._size += 1
        return self._size - 1

    def at(self, states: NDArray[np.float64]) -> NDArray[np.float64]:
        """(N,) counts at states (N, 2)."""
        return np.asarray(self._kernel(states[:, None]).sum(axis=1))

    def _kernel(self, states: NDArray[np.float64]) -> NDArray[np.float64]:
        """(..., M) what each visit counts for states (..., 2) or (..., 1, 2)."""
        offsets = (states - self._states[: self._size]) / self._radius
        return np.asarray(np.exp(-(offsets * offsets).sum(axis=-1)))
