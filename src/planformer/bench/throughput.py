"""How many queries a second all cores answer, on maps that are known and on new ones."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from itertools import islice, product
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from planformer.bench.environment import environment
from planformer.bench.reporting import interval_cell, prepared_folder, table_page, write_summary
from planformer.bench.statistics import interval_of
from planformer.data.problems import random_problems
from planformer.errors import InvalidParameter
from planformer.guidance import AUTO, resolve_guide
from planformer.maps import OccupancyGrid, generate_forest
from planformer.processes import cores
from planformer.robots import PointRobot
from planformer.session import MapSession, Query

QUERIES_PER_MAP = 10

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
        problems: Queries, `QUERIES_PER_MAP` on a map; a last map may have fewer.
        seed: Seed of maps and queries.
        report: Called with the number of measurements made and their total.

    Returns:
        The content of summary.json.

    Raises:
        InvalidParameter: A value is out of range.
        InvalidResults: The folder cannot take the results.
    """
    if problems < 1:
        raise InvalidParameter(f"problems must be >= 1; got {problems}")
    output = prepared_folder(folder)
    cases = list(product(("known", "new"), sorted({1, cores()}), TASKS))
    counts = [QUERIES_PER_MAP] * (problems // QUERIES_PER_MAP) + [problems % QUERIES_PER_MAP]
    batches = [_batch(seed, index, count) for index, count in enumerate(counts) if count]
    resolve_guide(AUTO, PointRobot())  # loads the weights, which no query does
    lines = []
    for number, (maps, workers, task) in enumerate(cases):
        runs = [_timed(batch, TASKS[task], workers, known=maps == "known") for batch in batches]
        queries, answered, seconds = np.array(runs).T
        lines.append(
            {
                "maps": maps,
                "workers": workers,
                "task": task,
                "queries": problems,
                "answered": int(answered.sum()),
                "per_second": interval_of(_rate, queries, seconds),
            }
        )
        if report:
            report(number + 1, len(cases))
    summary = {"sessions": [environment()], "lines": lines}
    write_summary(output, summary, markdown(summary))
    return summary


def _batch(seed: int, index: int, queries: int) -> Batch:
    """A map with queries on it."""
    rng = np.random.default_rng([seed, index])
    grid = generate_forest(int(rng.integers(2**31)))
    problems = random_problems(grid, PointRobot(), min_distance=_LEAST_DISTANCE, rng=rng)
    return grid, [(problem.start, problem.goal) for problem in islice(problems, queries)]


def _timed(
    batch: Batch, task: Callable[[Batch, int], int], workers: int, *, known: bool
) -> tuple[int, int, float]:
    """Queries, how many of them were answered, and seconds."""
    old, queries = batch
    grid = OccupancyGrid(old.occupied, old.resolution, old.origin)  # nothing is known of it
    if known:
        grid.components(PointRobot().radius)
    started = time.perf_counter()
    answered = task((grid, queries), workers)
    return len(queries), answered, time.perf_counter() - started


def _rate(queries: NDArray[np.float64], seconds: NDArray[np.float64], axis: int) -> Any:
    """Queries a second, a statistic for intervals over maps."""
    return queries.sum(axis=axis) / seconds.sum(axis=axis)


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
            line["maps"],
            str(line["workers"]),
            line["task"],
            f"{line['answered']:,} of {line['queries']:,}",
            interval_cell(line["per_second"], ",.0f", with_ends=True),
        ]
        for line in summary["lines"]
    ]
    caption = (
        f"The same queries in all lines, {QUERIES_PER_MAP} on a map of 480 x 480 cells, 95 % "
        "intervals over the maps; on new maps the inflation by the robot counts."
    )
    return table_page(header, rows, summary, caption)
