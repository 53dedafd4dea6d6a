"""How good are the proposed regions, and how far should the threshold be relaxed?

For unseen maps and several rules for the threshold: are start and goal connected inside region and
free space, what share of the map is the region, how much longer than the shortest path is the
shortest path inside it, and how many vertices does RRT* need there?

    python benchmarks/regions.py --maps 50 --output benchmarks/results/regions.json
"""

from __future__ import annotations

import dataclasses
import time
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
from common import interval, save_result
from rich.console import Console
from rich.progress import track
from rich.table import Table

import planformer as pf
from planformer import _core
from planformer.data.problems import draw_problems
from planformer.geometry import polyline_length
from planformer.guidance import OnnxProposer, load_network
from planformer.guidance.region import Region, connecting_threshold, spread
from planformer.planning import Problem, SearchLimits, is_connected, search

SEED = 20_000
"""First map seed; training and validation data draw theirs elsewhere."""
SLACK = 1.02
RULES: dict[str, float | None] = {
    "fixed 0.5": None,
    "connecting": 1.0,
    "connecting x 0.5": 0.5,
    "connecting x 0.2": 0.2,
    "connecting x 0.1": 0.1,
    "connecting x 0.05": 0.05,
}
KINDS = {
    "forest": pf.generate_forest,
    "maze": pf.generate_maze,
    "indoor": pf.generate_indoor,
}


def shortest_length(problem: Problem, blocked: np.ndarray) -> float:
    """Length of the any-angle shortest path in metres, infinite if there is none."""
    path = _core.lazy_theta(
        np.ascontiguousarray(blocked),
        problem.grid.resolution,
        problem.local_start[:2],
        problem.local_goal[:2],
    )
    return polyline_length(path) if len(path) else np.inf


def with_threshold(region: Region, cells: np.ndarray, problem: Problem, value: float) -> Region:
    """The same proposal at another threshold."""
    mask = cells >= value
    joined = is_connected(mask & ~problem.blocked, problem)
    return dataclasses.replace(region, threshold=value, mask=mask, connected=joined)


def measure(problem: Problem, proposer: OnnxProposer, seed: int) -> list[dict[str, Any]]:
    """One row a rule."""
    started = time.perf_counter()
    proposal = proposer.propose(problem)
    seconds = time.perf_counter() - started
    cells = spread(proposal.probability, problem.grid, proposer.network.scale)
    connecting = connecting_threshold(cells, problem)
    assert connecting is not None  # the problems can be solved
    best = shortest_length(problem, problem.blocked)
    limits = SearchLimits(seconds=3.0, target_length=SLACK * best)
    rows = []
    for rule, factor in RULES.items():
        value = 0.5 if factor is None else factor * connecting
        region = with_threshold(proposal, cells, problem, value)
        found = search(
            problem,
            "RRTstar",
            region=region.sampling(),
            refinement=0.0,
            limits=limits,
            seed=seed,
        )
        rows.append(
            {
                "rule": rule,
                "connected": region.connected,
                "share": region.share,
                "ratio": shortest_length(problem, problem.blocked | ~region.mask) / best,
                "reached": found.status is pf.PlanStatus.TARGET_REACHED,
                "vertices": found.vertices,
                "planning_ms": found.planning_seconds * 1e3,
                "proposal_ms": seconds * 1e3,
            }
        )
    return rows


def summary(rows: list[dict[str, Any]]) -> dict[str, Any]:
    """Shares in percent and medians, with 95 % intervals; failures stay in the medians."""
    column = {key: np.array([row[key] for row in rows], float) for key in rows[0] if key != "rule"}
    return {
        "problems": len(rows),
        "connected_percent": interval(100 * column["connected"], np.mean),
        "share_percent": interval(100 * column["share"], np.mean),
        "length_ratio_p90": float(np.quantile(column["ratio"], 0.9)),
        "reached_percent": interval(100 * column["reached"], np.mean),
        "vertices": interval(column["vertices"], np.median),
        "planning_ms": interval(column["planning_ms"], np.median),
        "proposal_ms": interval(column["proposal_ms"], np.median),
    }


def print_table(kind: str, results: dict[str, Any]) -> None:
    """A table for people."""
    columns = list(next(iter(results.values())))[1:]
    table = Table("rule", *columns, title=kind)
    for rule, row in results.items():
        cells = [row[c] if isinstance(row[c], float) else row[c]["value"] for c in columns]
        table.add_row(rule, *(f"{cell:.4g}" for cell in cells))
    Console().print(table)


def main(
    guide: Annotated[str, typer.Option(help="Weights to measure.")] = "mpt",
    maps: Annotated[int, typer.Option(help="Maps of each kind.")] = 50,
    paths: Annotated[int, typer.Option(help="Problems a map.")] = 2,
    output: Annotated[Path | None, typer.Option(help="Where to write the JSON.")] = None,
) -> None:
    """Measure the regions of a guide on unseen forests, mazes and floor plans."""
    proposer = OnnxProposer(load_network(guide))
    result: dict[str, Any] = {}
    for kind, generate in KINDS.items():
        rows: list[dict[str, Any]] = []
        for seed in track(range(SEED, SEED + maps), kind):
            grid, robot = generate(seed), pf.PointRobot()
            rng = np.random.default_rng(seed)
            starts, goals = draw_problems(grid, robot.radius, paths, min_distance=3.0, rng=rng)
            for start, goal in zip(starts, goals, strict=True):
                rows += measure(Problem(grid, robot, tuple(start), tuple(goal)), proposer, seed)
        result[kind] = {
            rule: summary([row for row in rows if row["rule"] == rule]) for rule in RULES
        }
        print_table(kind, result[kind])
    if output is not None:
        settings = {"guide": proposer.network.weights.name, "seed": SEED, "slack": SLACK}
        save_result(output, settings, result)


if __name__ == "__main__":
    typer.run(main)
