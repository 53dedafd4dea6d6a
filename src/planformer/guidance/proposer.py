"""What can guide a planner."""

from __future__ import annotations

from typing import Protocol, runtime_checkable

from planformer.guidance.region import Region
from planformer.planning import Problem


@runtime_checkable
class RegionProposer(Protocol):
    """Anything that proposes where on a map a good path runs."""

    def propose(self, problem: Problem) -> Region:
        """Propose a region for a problem."""
        ...
