"""Does memory stay flat? Many plans of one problem in one process.

RRT*, RRT-Connect and BIT* in turn, guided by the shipped network and unguided, each to its first
path; then the growth of the process's resident memory since the first tenth of the plans.

    python benchmarks/memory.py --plans 10000 --output benchmarks/results/memory.json
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated

import typer
from common import save_result
from rich.console import Console
from rich.progress import track
from rich.table import Table

import planformer as pf

START, GOAL = (1.5, 1.5), (22.5, 22.5)
ROUND = [
    (planner, guide) for planner in ("RRTstar", "RRTConnect", "BITstar") for guide in (None, "mpt")
]


def resident_megabytes() -> float:
    """Resident memory of this process."""
    pages = int(Path("/proc/self/statm").read_text(encoding="utf-8").split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / 2**20


def demo_map() -> pf.OccupancyGrid:
    """The first forest in which start and goal are free."""
    for seed in range(100):
        grid = pf.generate_forest(seed)
        cells = grid.to_rc([START, GOAL])
        if not grid.blocked(0.1)[cells[:, 0], cells[:, 1]].any():
            return grid
    raise RuntimeError("no forest leaves start and goal free")


def main(
    plans: Annotated[int, typer.Option(help="Plans altogether.")] = 10_000,
    output: Annotated[Path | None, typer.Option(help="Where to write the JSON.")] = None,
) -> None:
    """Plan often and watch the memory."""
    grid, robot = demo_map(), pf.PointRobot()
    samples: dict[str, float] = {}
    solved = 0
    for number in track(range(plans + 1), "plans"):
        if number % max(plans // 10, 1) == 0:
            samples[str(number)] = resident_megabytes()
        planner, guide = ROUND[number % len(ROUND)]
        result = pf.plan(
            grid, robot, START, GOAL, planner=planner, guide=guide, target_length=1e3, seed=number
        )
        solved += result.solved
    table = Table("plans", "resident MB", title=f"{solved} of {plans + 1} plans solved")
    for number, megabytes in samples.items():
        table.add_row(number, f"{megabytes:.1f}")
    Console().print(table)
    values = list(samples.values())
    growth = max(values[1:]) - values[1]
    Console().print(f"growth since the first tenth: {growth:.1f} MB")
    if output is not None:
        result = {"resident_megabytes": samples, "growth_megabytes": growth, "solved": solved}
        save_result(output, {"plans": plans, "round": ROUND}, result)


if __name__ == "__main__":
    typer.run(main)
