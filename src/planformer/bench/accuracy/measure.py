"""Measure guides on one problem: propose a region, search in it alone.

Where a run finds a path that is shorter than the reference, that becomes the reference and the
problem is measured again, so that all runs aim at one length.
"""

from __future__ import annotations

import dataclasses
import math
import time
from dataclasses import dataclass

import numpy as np

from planformer.bench.accuracy.record import Record
from planformer.bench.guides import IDEAL, PathProposer, Variant, variants
from planformer.bench.problems import ROUNDS, BenchProblem, make_problem
from planformer.bench.rows import Row
from planformer.bench.running import FAILURES, Job
from planformer.data.experts import shortest_path
from planformer.errors import InvalidParameter
from planformer.geometry import polyline_length
from planformer.guidance import Region
from planformer.maps import OccupancyGrid
from planformer.planning import PlanResult, Problem, SamplingRegion, SearchLimits, search

PLANNER = "RRTstar"


@dataclass(frozen=True)
class AccuracySettings:
    """What the accuracy of guides depends on, the rows apart.

    Attributes:
        guides: What is measured, see `planformer.bench.guides.Variant`.
        seed: Seed of the problems, 0 to 2**32 - 1.
        seconds: Limit of every search; None for the row's.
        max_vertices: Limit of a search tree; None for none.

    Raises:
        InvalidParameter: A value is out of range.
    """

    guides: tuple[str, ...] = ("mpt", IDEAL)
    seed: int = 0
    seconds: float | None = None
    max_vertices: int | None = None

    def __post_init__(self) -> None:
        if not self.guides or len(set(self.guides)) < len(self.guides):
            raise InvalidParameter(f"guides must be one or more different; got {self.guides}")
        if not 0 <= self.seed < 2**32:
            raise InvalidParameter(f"seed must be between 0 and 2**32 - 1; got {self.seed}")
        SearchLimits(seconds=self.seconds, max_vertices=self.max_vertices)

    def limits(self, row: Row, target_length: float) -> SearchLimits:
        """When a search ends on a problem of a row."""
        seconds = row.seconds if self.seconds is None else self.seconds
        return SearchLimits(seconds, target_length, self.max_vertices)


def measure_problem(settings: AccuracySettings, job: Job) -> list[Record]:
    """Measure all variants on a problem, one after the other.

    Each problem begins with another variant, so that none always runs first.

    Args:
        settings: The settings.
        job: The row and the problem's number in it.

    Returns:
        A record a variant, also for one that fails.

    Raises:
        InvalidParameter: The row has no such problem.
    """
    row, index = job
    known = make_problem(row, index, settings.seed)
    assert known.problem.is_connected  # found here, where no variant's time counts
    wanted = variants(settings.guides, row)
    first = index % max(len(wanted), 1)
    order = wanted[first:] + wanted[:first]
    for _ in range(ROUNDS):
        searches = _Searches(settings.limits(row, known.target_length), known)
        by_variant = {variant: _run(known, variant, searches) for variant in order}
        runs = [by_variant[variant] for variant in wanted]
        found = (run.result.path for run in runs if run.result and run.result.solved)
        better = known.improved(found)
        if better is None:
            break
        known = better
    return [run.record for run in runs]


def lost_records(settings: AccuracySettings, job: Job, cause: str) -> list[Record]:
    """Records of a problem on which every variant counts as failed."""
    row, index = job
    return [_lost(row, index, variant, cause) for variant in variants(settings.guides, row)]


@dataclass(frozen=True, eq=False)
class _Run:
    record: Record
    result: PlanResult | None = None


@dataclass(frozen=True, eq=False)
class _Proposal:
    region: Region
    sampling: SamplingRegion | None
    seconds: float


class _Searches:
    """The searches on a problem; the same region, from the same seed, is searched once."""

    def __init__(self, limits: SearchLimits, known: BenchProblem) -> None:
        self._limits, self._known = limits, known
        self._done: dict[tuple[object, ...], PlanResult] = {}

    def search(self, region: SamplingRegion) -> PlanResult:
        """Search a region, or give the result of having done so."""
        values = (getattr(region, field.name) for field in dataclasses.fields(region))
        key = tuple(v.tobytes() if isinstance(v, np.ndarray) else v for v in values)
        if key not in self._done:
            self._done[key] = search(
                self._known.problem,
                PLANNER,
                region=region,
                refinement=0.0,  # nothing but the region
                limits=self._limits,
                seed=self._known.seed,
            )
        return self._done[key]


def _run(known: BenchProblem, variant: Variant, searches: _Searches) -> _Run:
    try:
        proposal = _propose(variant, known)
        result = None if proposal.sampling is None else searches.search(proposal.sampling)
        return _Run(_record(known, variant, proposal, result), result)
    except FAILURES as error:
        cause = " ".join(f"{type(error).__name__}: {error}".split())
        return _Run(_lost(known.row, known.index, variant, cause))


def _propose(variant: Variant, known: BenchProblem) -> _Proposal:
    proposer = variant.proposer(known.reference)
    started = time.perf_counter()
    region = proposer.propose(known.problem)
    sampling = region.sampling()
    return _Proposal(region, sampling, time.perf_counter() - started)


def _record(
    known: BenchProblem, variant: Variant, proposal: _Proposal, result: PlanResult | None
) -> Record:
    problem, region = known.problem, proposal.region
    ideal = PathProposer(known.reference, variant.scale).propose(problem)
    target = known.target_length
    inside = _inside_length(problem, region) if known.row.plane else math.nan
    solved = result is not None and result.length <= target
    return Record(
        row=known.row.name,
        problem=known.index,
        scene=known.scene,
        replaced=known.replaced,
        guide=variant.guide,
        threshold=variant.threshold,
        status="" if result is None else result.status.value,
        solved=solved,
        cause="" if solved else _cause(proposal, result, narrow=inside > target),
        connected=region.connected,
        share=region.share,
        ideal_share=ideal.share,
        reference_length=known.reference_length,
        inside_length=inside,
        length=math.inf if result is None else result.length,
        vertices=0 if result is None else result.vertices,
        proposal_seconds=proposal.seconds,
        planning_seconds=0.0 if result is None else result.planning_seconds,
    )


def _cause(proposal: _Proposal, result: PlanResult | None, *, narrow: bool) -> str:
    """Why a problem is not solved."""
    if result is None:
        return "empty region"
    if not proposal.region.connected:
        return "not connected"
    return "no short path in the region" if narrow else result.status.value


def _inside_length(problem: Problem, region: Region) -> float:
    """Length of the any-angle shortest path inside the region, infinite without one."""
    outside = problem.blocked | ~region.mask
    grid = OccupancyGrid(outside, problem.grid.resolution, problem.grid.origin)
    path = shortest_path(grid, 0.0, problem.start, problem.goal)
    return math.inf if path is None else polyline_length(path)


def _lost(row: Row, index: int, variant: Variant, cause: str) -> Record:
    """The record of a run that gave no result."""
    return Record(
        row=row.name,
        problem=index,
        scene="",
        replaced=0,
        guide=variant.guide,
        threshold=variant.threshold,
        status="",
        solved=False,
        cause=cause,
        connected=False,
        share=math.nan,
        ideal_share=math.nan,
        reference_length=math.nan,
        inside_length=math.nan,
        length=math.inf,
        vertices=0,
        proposal_seconds=math.nan,
        planning_seconds=math.nan,
    )
