"""What one guide achieved on one problem."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Record:
    """What one variant achieved on one problem.

    Attributes:
        row: Name of the problem's row.
        problem: Its number in the row.
        scene: Name of its scene, empty where the row has one only.
        replaced: How many problems were given up before it, see `make_problem`.
        guide: The guide.
        threshold: The rule for its threshold.
        status: Why the search ended, empty if there was none.
        solved: Whether the path is at most `slack` times as long as the reference.
        cause: Why it is not solved, empty if it is.
        connected: Whether start and goal are connected inside region and free space.
        share: Share of the map inside the region, NaN if there is no region.
        ideal_share: That of the ideal region of the guide's scale.
        reference_length: Length of the best path known in metres.
        inside_length: Length of the shortest path inside the region in metres, infinite without
            one; NaN for a car, for which it is not known.
        length: Length of the path in metres, infinite without a path.
        vertices: Vertices of the search tree.
        proposal_seconds: Time of the proposal.
        planning_seconds: Time of the search.
    """

    row: str
    problem: int
    scene: str
    replaced: int
    guide: str
    threshold: str
    status: str
    solved: bool
    cause: str
    connected: bool
    share: float
    ideal_share: float
    reference_length: float
    inside_length: float
    length: float
    vertices: int
    proposal_seconds: float
    planning_seconds: float

    @property
    def seconds(self) -> float:
        """Time of proposal and search."""
        return self.proposal_seconds + self.planning_seconds
