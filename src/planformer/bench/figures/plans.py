"""Plans for figures: a system on a problem of a benchmark's row, with its tree."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from planformer.api import plan
from planformer.bench.problems import BenchProblem, make_problem
from planformer.bench.rows import all_rows
from planformer.bench.tables.systems import CAR_SYSTEMS, POINT_SYSTEMS, GuidedPlanner
from planformer.errors import InvalidParameter
from planformer.planning import PlanResult


@dataclass(frozen=True, eq=False)
class Drawn:
    """A plan that a figure shows.

    Attributes:
        known: The problem, with its best known path.
        system: Name of the system.
        result: What it found, with its tree.
    """

    known: BenchProblem
    system: str
    result: PlanResult

    @property
    def detail(self) -> str:
        """Effort and outcome in a line; one run's time says little and differs every time."""
        result = self.result
        length = f"{result.length:.1f} m" if result.solved else "no path"
        reached = result.length <= self.known.target_length
        ending = "" if reached else f" ({result.status.value})"
        return f"{result.vertices:,} vertices, {length}{ending}"

    def record(self) -> dict[str, Any]:
        """What repeats the plan, and its numbers, as JSON-compatible values."""
        result = self.result
        return {
            "row": self.known.row.name,
            "problem": self.known.index,
            "search_seed": self.known.seed,
            "system": self.system,
            "status": result.status.value,
            "length": result.length if math.isfinite(result.length) else None,
            "target_length": self.known.target_length,
            "vertices": result.vertices,
        }


def known_problem(row: str, index: int, seed: int) -> BenchProblem:
    """A problem of a benchmark's row by name.

    Args:
        row: Name of a row of generated maps.
        index: Number of the problem, >= 0.
        seed: Seed of the problems, as in the tables.
    """
    return make_problem(all_rows()[row], index, seed)


def run(known: BenchProblem, system: str) -> Drawn:
    """Plan until the path is as short as the problem's row demands, or to the row's limit.

    Args:
        known: The problem.
        system: A planner of the tables, with or without a guide.

    Raises:
        InvalidParameter: The system is no planner with a tree.
    """
    chosen = (POINT_SYSTEMS if known.row.plane else CAR_SYSTEMS).get(system)
    if not isinstance(chosen, GuidedPlanner):
        raise InvalidParameter(f"{system} is no planner that has a tree on {known.row.name}")
    problem = known.problem
    result = plan(
        problem.grid,
        problem.robot,
        problem.start,
        problem.goal,
        planner=chosen.planner,
        guide=chosen.guide,
        threshold=chosen.threshold,
        exploration=chosen.exploration,
        refinement=chosen.refinement,
        time_limit=known.row.seconds,
        target_length=known.target_length,
        seed=known.seed,
        keep_tree=True,
    )
    return Drawn(known, system, result)
