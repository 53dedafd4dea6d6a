"""How time and memory of planning grow with the size of the map."""

from __future__ import annotations

import resource
from collections.abc import Callable, Mapping, Sequence
from contextlib import closing
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from planformer.bench.environment import environment
from planformer.bench.reporting import (
    interval_cell,
    millisecond_cell,
    prepared_folder,
    table_page,
    write_summary,
)
from planformer.bench.statistics import median_of, percent_of
from planformer.bench.tables.systems import POINT_SYSTEMS, GuidedPlanner
from planformer.bench.workers import Died, work_through
from planformer.data.experts import shortest_path
from planformer.data.problems import random_problems
from planformer.errors import InvalidParameter
from planformer.geometry import polyline_length
from planformer.maps import generate_forest
from planformer.planning import SearchLimits
from planformer.plotting import save_picture
from planformer.robots import PointRobot

SIZES = (240, 480, 960, 1920, 3840)
"""Sides of the square maps in cells of 0.05 m."""

SYSTEMS = (
    "MPT-RRT*",
    "MPT-BIT*",
    "IRRT*",
    "BIT*",
    "IRRT* (refined)",
    "BIT* (refined)",
    "Lazy Theta*",
)
"""What is measured, by the tables' names."""

SLACK, SECONDS = 1.05, 10.0
"""A path this many times as long as the shortest ends a search, and so does this limit."""

_CELL = 0.05
_LEAST_DISTANCE = 0.5
"""From start to goal, in sides of the map."""


def run_growth(
    folder: str | Path,
    *,
    problems: int = 20,
    sizes: Sequence[int] = SIZES,
    seed: int = 0,
    report: Callable[[int, int], None] | None = None,
) -> dict[str, Any]:
    """Plan on forests of growing size, each problem on a map of its own.

    Args:
        folder: Where summary.json, table.md and growth.png go.
        problems: Problems of each size.
        sizes: Sides of the maps in cells, ascending: memory is the most that any so far took.
        seed: Seed of maps and problems.
        report: Called with the number of problems measured and their total.

    Returns:
        The content of summary.json; times in seconds, memory in MB.

    Raises:
        InvalidParameter: A value is out of range.
        InvalidResults: The folder cannot take the results.
    """
    if problems < 1:
        raise InvalidParameter(f"problems must be >= 1; got {problems}")
    if not sizes or min(sizes) < 100:
        raise InvalidParameter(f"sizes must be >= 100 cells, at least one; got {tuple(sizes)}")
    output = prepared_folder(folder)
    lines: list[dict[str, Any]] = []
    # In a process of its own: memory that is counted is that of these plans.
    with closing(work_through(sizes, partial(_measure, problems, seed), 1)) as measured:
        for number, (size, result) in enumerate(measured):
            if isinstance(result, Died):
                raise RuntimeError(f"{result.cause} at {size} cells")
            lines += result
            if report:
                report((number + 1) * problems, len(sizes) * problems)
    summary = {"sessions": [environment()], "lines": lines}
    write_summary(output, summary, markdown(summary))
    save_picture(plot(summary), output / "growth.png")
    return summary


def _measure(problems: int, seed: int, size: int) -> list[dict[str, Any]]:
    """The lines of one size."""
    runs: dict[str, list[tuple[bool, float, float]]] = {name: [] for name in SYSTEMS}
    for index in range(problems):
        rng = np.random.default_rng([seed, size, index])
        grid = generate_forest(int(rng.integers(2**31)), width=size * _CELL, height=size * _CELL)
        least = _LEAST_DISTANCE * grid.width
        problem = next(random_problems(grid, PointRobot(), min_distance=least, rng=rng))
        shortest = shortest_path(grid, problem.robot.radius, problem.start, problem.goal)
        assert shortest is not None  # a point robot's problems are all solvable
        limits = SearchLimits(SECONDS, SLACK * polyline_length(shortest))
        assert problem.is_connected  # what depends on the map alone is no system's time
        first = index % len(SYSTEMS)
        for name in (*SYSTEMS[first:], *SYSTEMS[:first]):
            found = POINT_SYSTEMS[name].solve(problem, limits, index)
            assert limits.target_length is not None
            solved = found.length <= limits.target_length
            total = found.proposal_seconds + found.planning_seconds
            runs[name].append((solved, found.proposal_seconds, total if solved else SECONDS))
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    return [_line(size, name, np.array(of_system), memory) for name, of_system in runs.items()]


def _line(size: int, name: str, runs: Any, memory: float) -> dict[str, Any]:
    solved, proposal, total = runs.T
    guided = isinstance(system := POINT_SYSTEMS[name], GuidedPlanner) and system.guide is not None
    return {
        "size": size,
        "system": name,
        "problems": len(runs),
        "solved_percent": percent_of(solved > 0),
        "seconds": median_of(total),
        "proposal_seconds": median_of(proposal) if guided else None,
        "memory_mb": round(memory, 1),
    }


def markdown(summary: Mapping[str, Any]) -> str:
    """A table of medians, and how they were measured."""
    header = ["side in cells", "system", "solved %", "total ms", "of which proposal ms", "peak MB"]
    rows = [
        [
            f"{line['size']:,}",
            line["system"],
            interval_cell(line["solved_percent"], ".0f", with_ends=True),
            millisecond_cell(line["seconds"]),
            millisecond_cell(line["proposal_seconds"]) if line["proposal_seconds"] else "",
            f"{line['memory_mb']:.0f}",
        ]
        for line in summary["lines"]
    ]
    caption = (
        f"Medians with 95 % intervals of {summary['lines'][0]['problems']} problems a size, until "
        f"the path is at most {SLACK} times the shortest; failures count with {SECONDS:.0f} s. The "
        "systems take turns; the map's inflation by the robot is done before. "
        "Peak: resident memory of the process that ran all systems up to this size."
    )
    return table_page(header, rows, summary, caption)


def plot(summary: Mapping[str, Any]) -> Figure:
    """Median time over the side of the map with its 95 % interval, on logarithmic axes."""
    figure = Figure(figsize=(7.0, 4.5), dpi=130, facecolor="white", layout="constrained")
    axes = figure.subplots()
    for name in SYSTEMS:
        lines = [line for line in summary["lines"] if line["system"] == name]
        sizes = [line["size"] for line in lines]
        times = np.array([_milliseconds(line["seconds"]) for line in lines])
        drawn = axes.plot(sizes, times[:, 1], "o-", label=name)
        axes.fill_between(sizes, times[:, 0], times[:, 2], color=drawn[0].get_color(), alpha=0.12)
        if name == "MPT-RRT*":
            proposal = [_milliseconds(line["proposal_seconds"])[1] for line in lines]
            axes.plot(sizes, proposal, ":", color=drawn[0].get_color(), label="MPT's proposal")
    axes.set_xscale("log", base=2)
    axes.set_yscale("log")
    axes.set_xticks(sizes, [f"{size:,}" for size in sizes])
    axes.set_xlabel("side of the map in cells of 0.05 m")
    axes.set_ylabel("median time [ms]")
    axes.grid(alpha=0.3)
    axes.legend(frameon=False)
    return figure


def _milliseconds(interval: Mapping[str, float]) -> list[float]:
    """Lower end, median and upper end."""
    return [1e3 * interval[end] for end in ("low", "value", "high")]
