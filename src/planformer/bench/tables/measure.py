"""Measure systems on one problem, one after the other.

Where a run finds a path that is shorter than the reference, that becomes the reference and the
problem is measured again, so that all runs aim at one length.
"""

from __future__ import annotations

import dataclasses
import math
from contextlib import closing
from dataclasses import dataclass
from enum import Enum
from functools import partial

import numpy as np

from planformer.bench.problems import ROUNDS, BenchProblem, make_problem
from planformer.bench.rows import Row
from planformer.bench.running import FAILURES, Job
from planformer.bench.tables.record import Trial
from planformer.bench.tables.systems import CAR_SYSTEMS, POINT_SYSTEMS, Solution, System
from planformer.bench.workers import Died, work_through
from planformer.errors import InvalidParameter
from planformer.planning import SearchLimits, search


class Reference(str, Enum):
    """The length that a path is measured against: the best known, or RRT*'s as in the paper."""

    BEST = "best"
    RRT_STAR = "rrtstar"


@dataclass(frozen=True)
class TableSettings:
    """What the trials depend on, the rows apart.

    Attributes:
        slack: A path this many times as long as the reference solves the problem.
        seconds: Limit of every search of a planner.
        reference: What the reference is.
        reference_seconds: Time for RRT* where its path is the reference; the paper's took 90.
        seed: Seed of the problems, 0 to 2**32 - 1.
        systems: Names of the systems; None for all.

    Raises:
        InvalidParameter: A value is out of range, or a name unknown.
    """

    slack: float = 1.01
    seconds: float = 5.0
    reference: Reference | str = Reference.BEST
    reference_seconds: float = 90.0
    seed: int = 0
    systems: tuple[str, ...] | None = None

    def __post_init__(self) -> None:
        try:
            object.__setattr__(self, "reference", Reference(self.reference))
        except ValueError:
            valid = ", ".join(kind.value for kind in Reference)
            raise InvalidParameter(
                f"reference must be one of {valid}; got {self.reference!r}"
            ) from None
        if not (math.isfinite(self.slack) and self.slack >= 1.0):
            raise InvalidParameter(f"slack must be finite and >= 1; got {self.slack}")
        for name in ("seconds", "reference_seconds"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0.0):
                raise InvalidParameter(f"{name} must be finite and > 0; got {value}")
        if not 0 <= self.seed < 2**32:
            raise InvalidParameter(f"seed must be between 0 and 2**32 - 1; got {self.seed}")
        known = {**POINT_SYSTEMS, **CAR_SYSTEMS}
        if unknown := [name for name in self.systems or () if name not in known]:
            raise InvalidParameter(
                f"unknown systems {', '.join(unknown)}; choose from {', '.join(known)}"
            )

    def systems_of(self, row: Row) -> dict[str, System]:
        """The systems that are measured on a row."""
        all_systems = POINT_SYSTEMS if row.plane else CAR_SYSTEMS
        if self.systems is None:
            return dict(all_systems)
        return {name: system for name, system in all_systems.items() if name in self.systems}


def measure_problem(settings: TableSettings, job: Job) -> list[Trial]:
    """Measure all systems on a problem.

    Each problem begins with another system, so that none always runs first.

    Args:
        settings: The settings.
        job: The row and the problem's number in it.

    Returns:
        A trial for each system, in the order of `TableSettings.systems_of`.
    """
    row, index = job
    row = dataclasses.replace(row, slack=settings.slack, seconds=settings.seconds)
    known = _with_reference(make_problem(row, index, settings.seed), settings)
    assert known.problem.is_connected  # found here, where no system's time counts
    systems = settings.systems_of(row)
    names = [*systems][index % len(systems) :] + [*systems][: index % len(systems)]
    for _ in range(ROUNDS):
        runs = {name: _run(known, name, systems[name]) for name in names}
        if settings.reference is Reference.RRT_STAR:
            break
        found = (solution.path for _, solution in runs.values() if solution is not None)
        better = known.improved(path for path in found if path is not None)
        if better is None:
            break
        known = better
    return [runs[name][0] for name in systems]


def measure_without_deaths(settings: TableSettings, job: Job, cause: str) -> list[Trial]:
    """Measure a problem again that took its process down.

    Systems that do so alone are counted failures, the others are measured together.

    Args:
        settings: The settings.
        job: The row and the problem's number in it.
        cause: How the process died; of systems that die together, but not alone.

    Returns:
        As `measure_problem`.
    """
    row, index = job
    names = [*settings.systems_of(row)]
    each = [dataclasses.replace(settings, systems=(name,)) for name in names]
    alone = zip(names, _in_processes(each, job), strict=True)
    causes = {name: outcome.cause for name, outcome in alone if isinstance(outcome, Died)}
    healthy = tuple(name for name in names if name not in causes)
    trials = {name: _failed(row.name, index, name, causes.get(name, cause)) for name in names}
    if healthy:
        (outcome,) = _in_processes([dataclasses.replace(settings, systems=healthy)], job)
        if not isinstance(outcome, Died):
            trials |= {trial.system: trial for trial in outcome}
    return [trials[name] for name in names]


def _in_processes(choices: list[TableSettings], job: Job) -> list[list[Trial] | Died]:
    """Measure a problem with each settings, one after the other in a process that may die."""
    with closing(work_through(choices, partial(_measure_job, job), 1)) as outcomes:
        return [outcome for _, outcome in outcomes]


def _measure_job(job: Job, settings: TableSettings) -> list[Trial]:
    return measure_problem(settings, job)


def _with_reference(known: BenchProblem, settings: TableSettings) -> BenchProblem:
    if settings.reference is Reference.BEST:
        return known
    limits = SearchLimits(settings.reference_seconds)
    found = search(known.problem, "RRTstar", refinement=0.0, limits=limits, seed=known.seed)
    # Without a path of RRT* the problem keeps its own reference.
    return dataclasses.replace(known, reference=found.path) if found.solved else known


def _run(known: BenchProblem, name: str, system: System) -> tuple[Trial, Solution | None]:
    limits = SearchLimits(known.row.seconds, known.target_length)
    try:
        solution = system.solve(known.problem, limits, known.seed)
    except FAILURES as error:
        cause = " ".join(f"{type(error).__name__}: {error}".split())
        return _failed(known.row.name, known.index, name, cause), None
    solved = solution.length <= known.target_length
    trial = Trial(
        row=known.row.name,
        problem=known.index,
        scene=known.scene,
        replaced=known.replaced,
        system=name,
        status=solution.status,
        solved=solved,
        cause="" if solved else _cause(solution),
        reference_length=known.reference_length,
        length=solution.length,
        vertices=solution.vertices,
        proposal_seconds=solution.proposal_seconds,
        planning_seconds=solution.planning_seconds,
    )
    return trial, solution


def _cause(solution: Solution) -> str:
    return solution.status if solution.path is not None else f"no path: {solution.status}"


def _failed(row: str, index: int, system: str, cause: str) -> Trial:
    """The trial of a run that gave no result."""
    nan = math.nan
    return Trial(row, index, "", 0, system, "", False, cause, nan, np.inf, 0, nan, nan)
