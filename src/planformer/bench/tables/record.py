"""What one system achieved on one problem."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Trial:
    """What one system achieved on one problem.

    Attributes:
        row: Name of the problem's row.
        problem: Its number in the row.
        scene: Name of its scene, empty where the row has one only.
        replaced: How many problems were given up before it, see `make_problem`.
        system: Name of the system.
        status: Why the search ended, empty if there was none.
        solved: Whether the path is at most `slack` times as long as the reference.
        cause: Why it is not solved, empty if it is.
        reference_length: Length of the reference in metres.
        length: Length of the path in metres, infinite without a path.
        vertices: Vertices of the search tree.
        proposal_seconds: Time of the proposal.
        planning_seconds: Time of the search.
    """

    row: str
    problem: int
    scene: str
    replaced: int
    system: str
    status: str
    solved: bool
    cause: str
    reference_length: float
    length: float
    vertices: int
    proposal_seconds: float
    planning_seconds: float

    @property
    def seconds(self) -> float:
        """Time of proposal and search."""
        return self.proposal_seconds + self.planning_seconds
