"""How far is the paper's expert, RRT* with a time limit, from the experts that label by default?

On unseen maps, the length of what RRT* has found after a while over the length of the default
expert's path: Lazy Theta* for the point robot, Hybrid-A* for the car.

    python benchmarks/experts.py --problems 20 --output benchmarks/results/experts.json
"""

from __future__ import annotations

import time
from collections import defaultdict
from collections.abc import Iterator
from itertools import islice
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
from common import interval, save_result
from rich.console import Console
from rich.progress import track
from rich.table import Table

import planformer as pf
from planformer.data.experts import create_expert, expert_names
from planformer.data.problems import random_problems
from planformer.geometry import polyline_length
from planformer.planning import Problem, SearchLimits, search
from planformer.robots import Robot

SEED = 30_000
"""First map seed; training and validation data draw theirs elsewhere."""
SECONDS = (1.0, 10.0)
POINT = pf.PointRobot(0.1)
CAR = pf.DubinsCar(0.2, 0.3 / np.tan(0.5))
ROWS = {
    "point, forest": (POINT, pf.generate_forest, {"min_distance": 3.0}),
    "point, maze": (POINT, pf.generate_maze, {"min_distance": 3.0}),
    "car, forest": (CAR, pf.generate_forest, {"min_distance": 4.0, "max_distance": 15.0}),
}


def solved_problems(
    robot: Robot, generate: Any, distances: dict[str, float]
) -> Iterator[tuple[Problem, float, float]]:
    """A problem from each map that the default expert solves; its length and seconds."""
    expert = create_expert(expert_names(robot)[0], robot)
    for seed in range(SEED, SEED + 10_000):
        grid = generate(seed, width=24.0, height=24.0)
        rng = np.random.default_rng(seed)
        problem = next(random_problems(grid, robot, rng=rng, **distances))
        started = time.perf_counter()
        path = expert.solve(problem, seed)
        if path is not None:
            yield problem, polyline_length(path[:, :2]), time.perf_counter() - started


def measure(problems: Iterator[tuple[Problem, float, float]], count: int, row: str) -> dict:
    """Ratios of RRT*'s lengths to the expert's, infinite where it has no path."""
    ratios, seconds = defaultdict(list), []
    for number, (problem, length, taken) in enumerate(
        track(islice(problems, count), row, total=count)
    ):
        seconds.append(taken)
        for limit in SECONDS:
            found = search(
                problem, "RRTstar", refinement=0.0, limits=SearchLimits(limit), seed=number
            )
            ratios[limit].append(found.length / length)
    return {
        "problems": count,
        "expert_milliseconds": interval(1e3 * np.array(seconds), np.median),
        "rrt_star": {f"{limit:g} s": summary(np.array(of)) for limit, of in ratios.items()},
    }


def summary(ratios: np.ndarray) -> dict:
    """How often RRT* had a path, and how long its paths were."""
    solved = ratios[np.isfinite(ratios)]
    return {
        "solved": interval(np.isfinite(ratios).astype(float), np.mean),
        "length_ratio": interval(solved, np.median) if len(solved) else None,
        "shorter_than_expert": float((ratios < 1.0).mean()),
        "least_length_ratio": float(solved.min(initial=np.inf)) if len(solved) else None,
    }


def show(result: dict[str, dict]) -> None:
    """Print the result as a table."""
    table = Table("problems", "expert [ms]", *(f"RRT* {limit:g} s" for limit in SECONDS))
    for row, values in result.items():
        cells = map(words, values["rrt_star"].values())
        table.add_row(row, f"{values['expert_milliseconds']['value']:.1f}", *cells)
    Console().print(table)


def words(of: dict) -> str:
    """One cell of the table."""
    share = f"{of['solved']['value']:.0%} solved"
    ratio = of["length_ratio"]
    return share if ratio is None else f"{share}, {ratio['value']:.4f} x the length"


def main(
    problems: Annotated[int, typer.Option(help="Problems a row, each on a map of its own.")] = 20,
    output: Annotated[Path | None, typer.Option(help="JSON file for the result.")] = None,
) -> None:
    """Measure, print and save."""
    result = {row: measure(solved_problems(*of), problems, row) for row, of in ROWS.items()}
    show(result)
    if output:
        save_result(output, {"problems": problems, "seconds": SECONDS, "map_seed": SEED}, result)


if __name__ == "__main__":
    typer.run(main)
