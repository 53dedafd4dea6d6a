"""How many queries a second all cores answer, on one map and on many."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np

from planformer.bench.environment import environment
from planformer.bench.reporting import table_page, write_summary
from planformer.data.problems import random_problems
from planformer.errors import InvalidParameter
from planformer.guidance import AUTO, resolve_guide
from planformer.maps import OccupancyGrid, generate_forest
from planformer.processes import cores
from planformer.robots import PointRobot
from planformer.session import MapSession, Query

QUERIES_PER_MAP = 10
"""Where there are many maps."""

_ANY_PATH = 1e9
"""Target length in metres: the first path ends a search."""
_LEAST_DISTANCE = 3.0

Batch = tuple[OccupancyGrid, Sequence[Query]]


def run_throughput(
    folder: str | Path,
    *,
    problems: int = 1000,
    seed: int = 0,
    report: Callable[[int, int], None] | None = None,
) -> dict[str, Any]:
    """Count proposals and plans a second on forests of 480 x 480 cells.

    Args:
        folder: Where summary.json and table.md go.
        problems: Queries on one map, and on maps of `QUERIES_PER_MAP` queries each.
        seed: Seed of maps and queries.
        report: Called with the number of measurements made and their total.

    Returns:
        The content of summary.json.

    Raises:
        InvalidParameter: A value is out of range.
    """
    if problems < 1:
        raise InvalidParameter(f"problems must be >= 1; got {problems}")
    count = cores()
    cases = [
        (maps, workers, task)
        for maps in dict.fromkeys((1, -(-problems // QUERIES_PER_MAP)))
        for workers in sorted({1, count})
        for task in TASKS
    ]
    resolve_guide(AUTO, PointRobot())  # loads the weights, which no query does
    lines = []
    for number, (maps, workers, task) in enumerate(cases):
        batches = [_batch(seed + index, max(problems // maps, 1)) for index in range(maps)]
        started = time.perf_counter()
        answered = sum(TASKS[task](batch, workers) for batch in batches)
        seconds = time.perf_counter() - started
        queries = sum(len(ends) for _, ends in batches)
        lines.append(
            {
                "maps": maps,
                "workers": workers,
                "task": task,
                "queries": queries,
                "answered": answered,
                "per_second": queries / seconds,
            }
        )
        if report:
            report(number + 1, len(cases))
    summary = {"sessions": [environment()], "lines": lines}
    write_summary(folder, summary, markdown(summary))
    return summary


def _batch(seed: int, queries: int) -> Batch:
    """A map of which nothing is known yet, with queries on it."""
    grid = generate_forest(seed)
    rng = np.random.default_rng(seed)
    problems = random_problems(grid, PointRobot(), min_distance=_LEAST_DISTANCE, rng=rng)
    ends = [(problem.start, problem.goal) for problem in islice(problems, queries)]
    return OccupancyGrid(grid.occupied, grid.resolution, grid.origin), ends


def _propose(batch: Batch, workers: int) -> int:
    grid, queries = batch
    session = MapSession(grid, PointRobot())
    with ThreadPoolExecutor(workers) as pool:
        regions = list(pool.map(lambda ends: session.propose_region(*ends), queries))
    return sum(region.connected for region in regions)


def _plan(batch: Batch, workers: int) -> int:
    grid, queries = batch
    session = MapSession(grid, PointRobot())
    results = session.plan_all(queries, workers=workers, target_length=_ANY_PATH, seed=0)
    return sum(result.solved for result in results)


TASKS: dict[str, Callable[[Batch, int], int]] = {"proposal": _propose, "first path": _plan}
"""What is asked, with what answers it: how many queries got a connected region or a path."""


def markdown(summary: Mapping[str, Any]) -> str:
    """Rates, and how they were measured."""
    header = ["maps", "threads", "query", "answered", "a second"]
    rows = [
        [
            str(line["maps"]),
            str(line["workers"]),
            line["task"],
            f"{line['answered']:,} of {line['queries']:,}",
            f"{line['per_second']:,.0f}",
        ]
        for line in summary["lines"]
    ]
    return table_page(header, rows, summary)
