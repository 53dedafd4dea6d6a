"""How long the proposal of a region takes, and which of its stages take how much of it."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from planformer.bench.environment import environment
from planformer.bench.reporting import (
    millisecond_cell,
    prepared_folder,
    table_page,
    write_summary,
)
from planformer.bench.rows import Row, chosen_rows
from planformer.bench.running import in_rows
from planformer.bench.statistics import interval_of, median_of, percentile_90
from planformer.data.problems import random_problems
from planformer.encoding import encode_windows, network_map
from planformer.guidance import OnnxProposer, load_network, make_region
from planformer.guidance.onnx import OnnxNetwork
from planformer.maps import OccupancyGrid
from planformer.planning import Problem

ROWS = ("forest-480", "maze-480", "forest-780", "dubins-forest-480")
"""What is measured: sizes in pixels, and both robots."""

STAGES = {
    "first": "first query on a map",
    "repeated": "another query on it",
    "query": "of which: start and goal, with the waves",
    "network": "the network",
    "region": "region and samples' shapes",
}
"""What is timed. The first query includes the map's inflation by the robot."""

_PER_MAP = 10


def run_latency(
    folder: str | Path,
    *,
    problems: int = 100,
    seed: int = 0,
    report: Callable[[int, int], None] | None = None,
) -> dict[str, Any]:
    """Time the shipped guides on problems on generated maps, ten problems a map.

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
        network = load_network("mpt" if row.plane else "mpt-dubins")
        times = [_measure(*_problems(row, index, seed), network) for index in indices]
        lines.append(_line(row, network, times))
    summary = {"sessions": [environment()], "lines": lines}
    write_summary(output, summary, markdown(summary))
    return summary


def _problems(row: Row, index: int, seed: int) -> tuple[Problem, Problem]:
    """Two problems on a map; the same ones for each seed."""
    rng = np.random.default_rng([seed, index])
    scene = row.scenes[0]
    grid = scene.maps.grid(int(np.random.default_rng([seed, index // _PER_MAP]).integers(2**31)))
    problems = random_problems(
        grid,
        scene.robot,
        min_distance=row.min_distance,
        max_distance=row.max_distance,
        rng=rng,
    )
    first, second = islice(problems, 2)
    return first, second


def _measure(first: Problem, problem: Problem, network: OnnxNetwork) -> dict[str, float]:
    """Seconds of each of `STAGES`: of a query on a map of which nothing is known, and of another.

    Of the other one's stages each is timed the second time that it runs.
    """
    proposer, grid = OnnxProposer(network), problem.grid
    fresh = OccupancyGrid(grid.occupied, grid.resolution, grid.origin)

    def propose(asked: Problem) -> object:
        # A problem of its own, as each query makes one.
        return proposer.propose(Problem(fresh, asked.robot, asked.start, asked.goal)).sampling()

    times = {
        "first": _seconds(lambda: propose(first)),
        "repeated": _seconds(lambda: propose(problem)),
    }
    prediction = network.predict(problem)
    pixels = network_map(problem.blocked, grid.resolution, network.scale)
    ends = problem.local_start, problem.local_goal
    inputs = [
        {"map": window.cut(pixels, network.scale.stride)[None, None], "query": query[None]}
        for window, query in encode_windows(pixels, *ends, network.scale)
    ]
    return times | {
        "query": _seconds(lambda: encode_windows(pixels, *ends, network.scale)),
        "network": _seconds(lambda: [network.session.run(None, part) for part in inputs]),
        "region": _seconds(
            lambda: make_region(
                problem,
                prediction.probability,
                network.scale,
                headings=prediction.headings,
                yaw_deviations=prediction.yaw_deviations,
                offsets=prediction.offsets,
            ).sampling()
        ),
    }


def _seconds(call: Callable[[], object]) -> float:
    started = time.perf_counter()
    call()
    return time.perf_counter() - started


def _line(row: Row, network: OnnxNetwork, times: list[dict[str, float]]) -> dict[str, Any]:
    columns: dict[str, NDArray[np.float64]] = {
        stage: np.array([of_problem[stage] for of_problem in times]) for stage in STAGES
    }
    return {
        "row": row.name,
        "guide": network.weights.name,
        "problems": len(times),
        "seconds": {stage: median_of(column) for stage, column in columns.items()},
        "seconds_p90": {
            stage: interval_of(percentile_90, column) for stage, column in columns.items()
        },
    }


def markdown(summary: Mapping[str, Any]) -> str:
    """Medians and 90th percentiles in milliseconds, a line a stage, and how they were measured."""
    lines = summary["lines"]
    header = ["ms", *(f"{line['row']}, {line['problems']} problems" for line in lines)]
    rows = [[meaning, *(_cell(line, stage) for line in lines)] for stage, meaning in STAGES.items()]
    caption = "Medians with 95 % intervals; 90th percentiles after the slash."
    return table_page(header, rows, summary, caption)


def _cell(line: Mapping[str, Any], stage: str) -> str:
    high = 1e3 * line["seconds_p90"][stage]["value"]
    return f"{millisecond_cell(line['seconds'][stage], '.2f')} / {high:.2f}"
