"""What some systems achieved on the same problems, as plots of statistics take it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from planformer.errors import InvalidResults

Dashes = str | tuple[int, tuple[float, ...]]
"""A line style of Matplotlib."""


@dataclass(frozen=True, eq=False)
class Outcomes:
    """What a system achieved on N problems.

    Attributes:
        name: Name of the system.
        colour: Its colour.
        dashes: Its line style.
        seconds: (N,) float64 time in seconds; for a failure what counts as its time.
        vertices: (N,) float64 vertices of the search trees, all 0 for a system without a tree.
        solved: (N,) bool, which problems are solved.
    """

    name: str
    colour: str
    dashes: Dashes
    seconds: NDArray[np.float64]
    vertices: NDArray[np.float64]
    solved: NDArray[np.bool_]

    @property
    def failures(self) -> int:
        """Number of problems that are not solved."""
        return int(np.sum(~self.solved))


def require_outcomes(systems: Sequence[Outcomes]) -> None:
    """Check that there is something to draw.

    Raises:
        InvalidResults: There is no system, or one has no problem.
    """
    if not systems or any(len(system.solved) == 0 for system in systems):
        raise InvalidResults("there are no results to draw: no system was run on any problem")
