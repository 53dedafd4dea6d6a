"""The problems of a row: the same ones for every run of a benchmark, on maps of their own.

Training data draw the map number i of a kind from ``SeedSequence(seed, spawn_key=...)`` with the
seed of the data set (`planformer.data.generate`). Problem maps here draw from ``SeedSequence(2**32
+ seed, spawn_key=...)``, so no data set of a seed below 2**32 shares one.
"""

from __future__ import annotations

import math
import zlib
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from planformer.bench.reference import reference_path
from planformer.bench.rows import Row, Scene
from planformer.data.problems import random_problems
from planformer.errors import InvalidParameter, InvalidProblem
from planformer.geometry import polyline_length
from planformer.maps import OccupancyGrid, load_scenarios
from planformer.planning import Problem

PROBLEMS_PER_MAP = 4
EVALUATION_ENTROPY = 2**32
"""Added to the seed: entropy that no data set of a smaller seed draws its maps from."""
ROUNDS = 3
"""How often a problem is measured at most, because a run found a better reference."""
_SHORTER = 1e-3
"""A reference gives way to a path that is shorter by this share."""
_ATTEMPTS = 20


@dataclass(frozen=True, eq=False)
class BenchProblem:
    """A problem with the best path known.

    Attributes:
        row: Its row.
        index: Its number in the row.
        scene: Name of its scene.
        problem: The problem.
        reference: (N, 2) or (N, 3) path in the world frame.
        seed: Seed for whatever the problem is measured with, below 2**32.
        replaced: How many maps or problems were given up before it.
    """

    row: Row
    index: int
    scene: str
    problem: Problem
    reference: NDArray[np.float64]
    seed: int
    replaced: int

    @property
    def reference_length(self) -> float:
        """Length of the reference in metres."""
        return polyline_length(self.reference)

    @property
    def target_length(self) -> float:
        """Length in metres up to which a path solves the problem."""
        return self.row.slack * self.reference_length

    def improved(self, paths: Iterable[NDArray[np.float64]]) -> BenchProblem | None:
        """The problem with the shortest of some paths as its reference.

        Args:
            paths: Valid paths, any number.

        Returns:
            None where no path is shorter than the reference by a thousandth.
        """
        best = min(paths, key=polyline_length, default=None)
        if best is None or polyline_length(best) >= (1.0 - _SHORTER) * self.reference_length:
            return None
        return replace(self, reference=best)


def make_problem(row: Row, index: int, seed: int) -> BenchProblem:
    """Draw a problem of a row.

    A map that has no problem, or a problem that the expert cannot solve, is replaced by that of
    the next attempt, and the number of attempts noted.

    Args:
        row: The row.
        index: The problem's number, >= 0; `PROBLEMS_PER_MAP` in a row share a map.
        seed: The benchmark's seed, >= 0.

    Raises:
        InvalidParameter: No attempt gives a problem.
    """
    number, place = divmod(index, PROBLEMS_PER_MAP)
    scene = row.scenes[number % len(row.scenes)]
    for attempt in range(_ATTEMPTS):
        problems, search_seeds = _problems_on_map(row, number, attempt, seed)
        if not problems:
            continue
        problem, search_seed = problems[place], search_seeds[place]
        reference = reference_path(problem, search_seed)
        if reference is not None:
            return BenchProblem(row, index, scene.name, problem, reference, search_seed, attempt)
    raise InvalidParameter(f"{_ATTEMPTS} attempts gave no problem {index} of the row {row.name}")


@lru_cache(maxsize=4)
def _problems_on_map(
    row: Row, number: int, attempt: int, seed: int
) -> tuple[list[Problem], list[int]]:
    """The problems of a map and a seed for each; no problems where the map has none."""
    key = (zlib.crc32(row.name.encode()), number, attempt)
    entropy = np.random.SeedSequence(EVALUATION_ENTROPY + seed, spawn_key=key)
    map_seed, problem_seed = (int(s) for s in entropy.generate_state(2, np.uint64))
    scene = row.scenes[number % len(row.scenes)]
    rng = np.random.default_rng(problem_seed)
    seeds = rng.integers(1, 2**32, size=PROBLEMS_PER_MAP).tolist()
    try:
        grid = scene.maps.grid(map_seed)
        problems = list(islice(_problems(row, scene, grid, rng), PROBLEMS_PER_MAP))
    except InvalidParameter:  # the generator failed, or the map has no room
        return [], seeds
    return problems if len(problems) == PROBLEMS_PER_MAP else [], seeds


def _problems(
    row: Row, scene: Scene, grid: OccupancyGrid, rng: np.random.Generator
) -> Iterator[Problem]:
    distances = row.min_distance, row.max_distance or math.inf
    if scene.scenarios is not None:
        return _from_scenarios(scene, grid, distances, rng)
    return random_problems(
        grid, scene.robot, min_distance=distances[0], max_distance=row.max_distance, rng=rng
    )


def _from_scenarios(
    scene: Scene, grid: OccupancyGrid, distances: tuple[float, float], rng: np.random.Generator
) -> Iterator[Problem]:
    """A file's problems in random order, but those that the robot's size makes impossible."""
    assert scene.scenarios is not None
    for scenario in rng.permutation(np.array(load_scenarios(scene.scenarios), dtype=object)):
        start, goal = scenario.start_and_goal(grid)
        if not distances[0] <= math.dist(start, goal) <= distances[1]:
            continue
        try:
            problem = Problem(grid, scene.robot, start, goal)
        except InvalidProblem:
            continue
        if problem.is_connected:
            yield problem
