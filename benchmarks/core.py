"""What do planners cost, and what is a region worth to them? One interleaved run.

Forests and mazes of 480 x 480 cells, point robot of 0.1 m. Every planner searches until its path is
within `slack` of the any-angle shortest path: unguided; in the region that the shipped network
proposes (time of the proposal included); and in the ideal region, 1.6 m squares round the anchors
within 0.7 m of the shortest path. Lazy Theta* itself is the control.

    python benchmarks/core.py --problems 40 --output benchmarks/results/core.json
"""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
from common import interval, save_result
from rich.console import Console
from rich.progress import track
from rich.table import Table

import planformer as pf
from planformer.data.experts import shortest_path
from planformer.data.problems import draw_problems
from planformer.encoding import NetworkScale, anchor_labels, anchor_points
from planformer.geometry import polyline_length
from planformer.guidance import OnnxProposer, Region, load_network, make_region
from planformer.planning import Problem, SearchLimits, search

SEED = 40_000
LIMIT = 10.0  # [s]; a search that ends there counts with what it took
PLANNERS = ("RRTstar", "InformedRRTstar", "BITstar")
KINDS: dict[str, Callable[[int], pf.OccupancyGrid]] = {
    "forest": pf.generate_forest,
    "maze": pf.generate_maze,
}


def ideal_region(problem: Problem, path: np.ndarray) -> Region:
    """The region of a network that makes no mistake."""
    scale = NetworkScale()
    height, width = problem.grid.shape
    anchors = anchor_points(scale.padded(height), scale.padded(width), scale)
    positive = anchor_labels(anchors, problem.grid.frame.to_local(path))
    return make_region(problem, positive.astype(np.float32), scale, threshold=0.5)


def measure(problem: Problem, proposer: OnnxProposer, slack: float, seed: int) -> dict[str, Any]:
    """(seconds, vertices, reached) of every variant."""
    started = time.perf_counter()
    path = shortest_path(problem.grid, problem.robot.radius, problem.start, problem.goal)
    rows = {"Lazy Theta*": (time.perf_counter() - started, 0, True)}
    limits = SearchLimits(seconds=LIMIT, target_length=slack * polyline_length(path))
    ideal = ideal_region(problem, path).sampling()
    for planner in PLANNERS:
        started = time.perf_counter()
        region = proposer.propose(problem).sampling()
        proposal = time.perf_counter() - started
        variants = {
            planner: (None, 0.0),
            f"MPT-{planner}": (region, proposal),
            f"ideal-{planner}": (ideal, 0.0),
        }
        for name, (where, before) in variants.items():
            found = search(problem, planner, region=where, limits=limits, seed=seed)
            reached = found.status is pf.PlanStatus.TARGET_REACHED
            rows[name] = (before + found.planning_seconds, found.vertices, reached)
    return rows


def summary(values: np.ndarray) -> dict[str, Any]:
    """Of (N, 3) seconds, vertices and reached."""
    return {
        "problems": len(values),
        "milliseconds": interval(1e3 * values[:, 0], np.median),
        "milliseconds_p90": float(1e3 * np.quantile(values[:, 0], 0.9)),
        "vertices": interval(values[:, 1], np.median),
        "reached_percent": float(100 * values[:, 2].mean()),
    }


def print_table(kind: str, slack: float, results: dict[str, Any]) -> None:
    """A table for people."""
    table = Table("planner", "ms", "p90 ms", "vertices", "reached %", title=f"{kind}, {slack}")
    for name, row in results.items():
        ms, vertices = row["milliseconds"], row["vertices"]
        table.add_row(
            name,
            f"{ms['value']:.1f} [{ms['low']:.1f}, {ms['high']:.1f}]",
            f"{row['milliseconds_p90']:.1f}",
            f"{vertices['value']:.0f} [{vertices['low']:.0f}, {vertices['high']:.0f}]",
            f"{row['reached_percent']:.0f}",
        )
    Console().print(table)


def main(
    problems: Annotated[int, typer.Option(help="Problems of each kind, one a map.")] = 40,
    slack: Annotated[float, typer.Option(help="Length to reach over the shortest.")] = 1.02,
    output: Annotated[Path | None, typer.Option(help="Where to write the JSON.")] = None,
) -> None:
    """Measure planners with and without guidance."""
    proposer = OnnxProposer(load_network("mpt"))
    result: dict[str, Any] = {}
    for kind, generate in KINDS.items():
        rows: dict[str, list[tuple[float, int, bool]]] = {}
        for seed in track(range(SEED, SEED + problems), kind):
            grid, robot = generate(seed), pf.PointRobot()
            rng = np.random.default_rng(seed)
            (start,), (goal,) = draw_problems(grid, robot.radius, 1, min_distance=3.0, rng=rng)
            problem = Problem(grid, robot, tuple(start), tuple(goal))
            for name, row in measure(problem, proposer, slack, seed).items():
                rows.setdefault(name, []).append(row)
        result[kind] = {name: summary(np.array(values, float)) for name, values in rows.items()}
        print_table(kind, slack, result[kind])
    if output is not None:
        settings = {"seed": SEED, "slack": slack, "limit_seconds": LIMIT}
        save_result(output, {**settings, "guide": proposer.network.weights.name}, result)


if __name__ == "__main__":
    typer.run(main)
