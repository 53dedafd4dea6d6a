"""What a plan returns."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from planformer import _core
from planformer.planning.problem import Problem

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class PlanStatus(str, Enum):
    """Why a search ended. Whether it found a path is `PlanResult.solved`."""

    FINISHED = "finished"
    """The planner ended by itself; one that only looks for any path has found it."""
    TARGET_REACHED = "target reached"
    """A path at most as long as the target length was found."""
    TIME_LIMIT = "time limit"
    VERTEX_LIMIT = "vertex limit"
    CANCELLED = "cancelled"
    UNREACHABLE = "unreachable"
    """No path exists: obstacles separate start and goal."""
    INVALID_PATH = "invalid path"
    """The planner's path failed the independent check and was withheld."""


@dataclass(frozen=True, eq=False)
class Tree:
    """The planner's search tree or roadmap.

    Attributes:
        vertices: (V, 2) or (V, 3) float64 states in the world frame.
        edges: (E, 2) int64 indices (parent, child) into the vertices.
    """

    vertices: NDArray[np.float64]
    edges: NDArray[np.int64]

    @classmethod
    def from_core(cls, found: _core.Answer | _core.Snapshot, problem: Problem) -> Tree:
        """The tree that the core found for a problem."""
        vertices = problem.grid.frame.to_world(found.tree_vertices)
        return cls(vertices[:, : problem.robot.state_dimension], found.tree_edges.astype(np.int64))


@dataclass(frozen=True, eq=False)
class PlanResult:
    """The answer of `plan`; no path within the limits is an answer too.

    Attributes:
        problem: What was asked: map, robot, start and goal.
        solved: Whether a valid path was found.
        status: Why the search ended.
        path: (N, 2) or (N, 3) float64 states in the world frame, shape (0, 2) or (0, 3) without a
            path. For a car these are dense poses: half a cell apart on arcs.
        length: Path length in metres, infinite without a path.
        vertices: Collision-free states in the search tree, the paper's measure of effort.
        planning_seconds: Wall-clock seconds of the search, its setup and the path's check included.
        proposal_seconds: Wall-clock seconds of the region proposal, 0 without a guide; with the
            loading of one given by name, which happens once.
        region: The proposed region (a `planformer.Region`), None without a guide, where obstacles
            separate start and goal, or if the search was cancelled before.
        tree: The search tree if it was asked for.
    """

    problem: Problem
    solved: bool
    status: PlanStatus
    path: NDArray[np.float64]
    length: float
    vertices: int
    planning_seconds: float
    proposal_seconds: float = 0.0
    region: Any = None
    tree: Tree | None = None

    def plot(self, *, title: str | None = None) -> Figure:
        """Draw map, region, search tree (of a plan with `keep_tree=True`), path, start and goal.

        Args:
            title: Line above the picture.

        Returns:
            A Matplotlib figure, which notebooks show. Its `savefig` writes a file.
        """
        from planformer.plotting import plot_result

        return plot_result(self, title=title)

    def _repr_html_(self) -> str:
        from planformer.notebook import result_html

        return result_html(self)

    def __repr__(self) -> str:
        outcome = f"length={self.length:.3f} m" if self.solved else "no path"
        return (
            f"PlanResult({outcome}, status={self.status.value!r}, vertices={self.vertices}, "
            f"planning={self.planning_seconds * 1e3:.1f} ms, "
            f"proposal={self.proposal_seconds * 1e3:.1f} ms)"
        )
