"""Plan on fixed problems and draw what was found, as the paper's figures do."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from types import MappingProxyType
from typing import Any

from matplotlib.figure import Figure

from planformer.bench.environment import environment
from planformer.bench.figures.draw import draw_cars, draw_prediction, draw_sizes, draw_trees
from planformer.bench.figures.plans import Drawn, known_problem, run
from planformer.bench.store import write_text
from planformer.errors import InvalidParameter
from planformer.files import make_folder
from planformer.plotting import save_picture

RECORD = "figures.json"
_SEED = 0
"""Of the problems: they are those of the tables."""


@dataclass(frozen=True)
class Recipe:
    """What a figure shows.

    Attributes:
        problems: Rows and numbers of the problems, chosen because they show what is typical of
            their row in a glance.
        systems: Each of them plans on each problem.
        draw: Draws the plans.
    """

    problems: Sequence[tuple[str, int]]
    systems: Sequence[str]
    draw: Callable[[Sequence[Drawn]], Figure]


_PLANNERS = ("RRT*", "IRRT*", "BIT*", "MPT-RRT*", "MPT-IRRT*", "MPT-BIT*")

FIGURES: Mapping[str, Recipe] = MappingProxyType(
    {
        "trees-forest": Recipe([("forest-480", 2)], _PLANNERS, partial(draw_trees, columns=3)),
        "trees-maze": Recipe([("maze-480", 12)], _PLANNERS, partial(draw_trees, columns=3)),
        "trees-car": Recipe(
            [("dubins-forest-480", 2)], ("RRT*", "MPT-RRT*"), partial(draw_trees, columns=2)
        ),
        "prediction": Recipe([("maze-480", 5)], ("MPT-RRT*",), draw_prediction),
        "sizes": Recipe(
            [
                ("forest-360x240", 8),
                ("forest-480x240", 6),
                ("forest-560", 6),
                ("forest-780", 16),
            ],
            ("MPT-RRT*",),
            draw_sizes,
        ),
        "cars": Recipe(
            [("dubins-forest-480", 0), ("dubins-forest-480", 2)], ("MPT-RRT*",), draw_cars
        ),
    }
)
"""The figures by the names of their files."""


def write_plan_figures(folder: Path, names: Sequence[str] | None = None) -> list[Path]:
    """Plan what the figures show, draw them as PNG, and note the plans in figures.json.

    What is noted there of other figures stays.

    Args:
        folder: Where the files go; made where it does not exist.
        names: Some of `FIGURES`; None for all.

    Returns:
        The files.

    Raises:
        InvalidParameter: A name is unknown, or the folder cannot be written to.
        UnknownGuide: The weights are not there.
    """
    if unknown := [name for name in names or () if name not in FIGURES]:
        raise InvalidParameter(
            f"unknown figures {', '.join(unknown)}; choose from {', '.join(FIGURES)}"
        )
    make_folder(folder)
    files, plans = [], {}
    for name in names or FIGURES:
        recipe = FIGURES[name]
        drawn = [
            run(known, system)
            for known in (known_problem(*problem, _SEED) for problem in recipe.problems)
            for system in recipe.systems
        ]
        plans[name] = {
            "environment": environment(),
            "seed": _SEED,
            "plans": [each.record() for each in drawn],
        }
        files.append(folder / f"{name}.png")
        save_picture(recipe.draw(drawn), files[-1])
    files.append(folder / RECORD)
    write_text(files[-1], json.dumps(_noted(files[-1]) | plans, indent=2) + "\n")
    return files


def _noted(record: Path) -> dict[str, Any]:
    """What a figures.json says so far, of the figures that there are."""
    try:
        noted = dict(json.loads(record.read_text(encoding="utf-8")))
    except (OSError, ValueError, TypeError):
        return {}
    return {name: noted[name] for name in FIGURES if name in noted}
