"""How well planners keep their time limit."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from planformer.bench.environment import environment
from planformer.bench.problems import BenchProblem, make_problem
from planformer.bench.reporting import prepared_folder, table_page, write_summary
from planformer.bench.rows import chosen_rows
from planformer.bench.running import in_rows
from planformer.guidance import AUTO, resolve_guide
from planformer.planning import SearchLimits, search

ROWS = ("maze-480", "dubins-forest-480")
"""Where planners work until their limit."""

PLANNERS = ("RRTstar", "InformedRRTstar", "BITstar")
LIMITS = (0.02, 0.1, 0.5)
"""Time limits in seconds."""

PROMISE = 0.005
"""Overrun in seconds that 99 of 100 searches should stay below."""

_PERCENTILES = (50, 99, 100)


def run_deadlines(
    folder: str | Path,
    *,
    problems: int = 100,
    seed: int = 0,
    report: Callable[[int, int], None] | None = None,
) -> dict[str, Any]:
    """Measure by how much searches overrun their time limit.

    Measured is the whole call, with the check of the path and the release of the search's memory.

    Args:
        folder: Where summary.json and table.md go.
        problems: Problems in each row.
        seed: Seed of maps and problems.
        report: Called with the number of problems measured and their total.

    Returns:
        The content of summary.json; times in seconds.

    Raises:
        InvalidParameter: A value is out of range.
        InvalidResults: The folder cannot take the results.
    """
    output = prepared_folder(folder)
    lines = []
    for row, indices in in_rows(chosen_rows(ROWS, None), problems, report):
        overruns: dict[tuple[str, float], list[float]] = {}
        for index in indices:
            for key, seconds in _measure(make_problem(row, index, seed)).items():
                overruns.setdefault(key, []).append(seconds)
        lines += [_line(row.name, *key, np.array(values)) for key, values in overruns.items()]
    summary = {"sessions": [environment()], "lines": lines}
    write_summary(output, summary, markdown(summary))
    return summary


def _measure(of_row: BenchProblem) -> dict[tuple[str, float], float]:
    """Seconds beyond the limit for each planner and limit."""
    problem = of_row.problem
    assert problem.is_connected  # found here, where no planner's time counts
    region = resolve_guide(AUTO, problem.robot).propose(problem).sampling()
    overruns = {}
    for planner in PLANNERS:
        for limit in LIMITS:
            started = time.perf_counter()
            search(problem, planner, region=region, limits=SearchLimits(limit), seed=of_row.seed)
            overruns[planner, limit] = max(time.perf_counter() - started - limit, 0.0)
    return overruns


def _line(row: str, planner: str, limit: float, overruns: NDArray[np.float64]) -> dict[str, Any]:
    percentiles = np.percentile(overruns, _PERCENTILES, method="inverted_cdf").tolist()
    return {
        "row": row,
        "planner": planner,
        "limit": limit,
        "problems": len(overruns),
        "overrun": dict(zip(map(str, _PERCENTILES), percentiles, strict=True)),
        "kept_percent": 100.0 * float(np.mean(overruns < PROMISE)),
    }


def markdown(summary: Mapping[str, Any]) -> str:
    """Percentiles of the overrun in milliseconds, and how they were measured."""
    header = ["row", "planner", "limit ms", "median", "99 %", "most", f"< {1e3 * PROMISE:.0f} ms"]
    rows = [
        [
            line["row"],
            line["planner"],
            f"{1e3 * line['limit']:.0f}",
            *(f"{1e3 * seconds:.2f}" for seconds in line["overrun"].values()),
            f"{line['kept_percent']:.0f} %",
        ]
        for line in summary["lines"]
    ]
    caption = (
        f"Overrun of the time limit in milliseconds, {summary['lines'][0]['problems']} problems "
        "a line."
    )
    return table_page(header, rows, summary, caption)
