"""The figures of a table: how time and vertices are distributed, and what is solved by when.

One figure of each kind for each row, drawn from the trials that the table's folder holds.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from planformer.bench.reporting import read_records, read_summary
from planformer.bench.tables.record import Trial
from planformer.bench.tables.summary import counted_seconds
from planformer.errors import InvalidResults
from planformer.plotting import plot_letter_values, plot_solved, save_picture
from planformer.plotting.outcomes import Dashes, Outcomes

LETTER_VALUES, SOLVED = "letter_values", "solved"
"""What the names of the files begin with; the row follows."""
_FORMATS = ("png", "svg")

_UNGUIDED = "#7d858f"
_COLOURS = {
    "(refined)": "#2f353b",
    "MPT": "#0173b2",
    "MPT (not refined)": "#6c71c4",
    "MPT (F.E.)": "#56b4e9",
    "MPT (S.E.)": "#a6cee3",
    "UNet": "#de8f05",
    "Corridor": "#029e73",
    "MPNet": "#ca9161",
    "NEXT-KS": "#8c564b",
    "A* + shortcut": "#cc78bc",
    "Lazy Theta*": "#cc78bc",
    "Hybrid-A*": "#cc78bc",
}
"""By what guides a planner, from seaborn's palette for the colour-blind; else `_UNGUIDED`."""

_DASHES: Mapping[str, Dashes] = {
    "IRRT*": "--",
    "BIT*": ":",
    "ABIT*": (0, (6.0, 1.5, 1.0, 1.5)),
    "AIT*": (0, (3.0, 1.0, 1.0, 1.0, 1.0, 1.0)),
    "SST": ":",
    "RRT*-EE": (0, (9.0, 2.0)),
    "Lazy Theta*": "--",
}
"""By the planner, which follows its guide in a system's name; else a solid line."""


def write_figures(folder: Path) -> list[Path]:
    """Draw the figures of a table into the folder of its results.

    Args:
        folder: A folder that `run_table` has written.

    Returns:
        The files, two figures as PNG and SVG for each row.

    Raises:
        InvalidResults: The folder holds no results of a table.
        InvalidParameter: The folder cannot be written to.
    """
    trials = read_records(folder, Trial)
    limit = _limit(folder)
    files = []
    for row in dict.fromkeys(trial.row for trial in trials):
        of_row = [trial for trial in trials if trial.row == row]
        for name, figure in figures(of_row, limit).items():
            for suffix in _FORMATS:
                files.append(folder / f"{name}-{row}.{suffix}")
                save_picture(figure, files[-1])
    return files


def figures(trials: Sequence[Trial], limit: float) -> dict[str, Figure]:
    """The figures of a row by `LETTER_VALUES` and `SOLVED`.

    Args:
        trials: The trials of a row.
        limit: Limit of a search in seconds.

    Raises:
        InvalidResults: No system was run.
    """
    systems = outcomes(trials, limit)
    problems = len({trial.problem for trial in trials})
    where = f"{trials[0].row}, {problems:,} problems" if trials else ""
    return {
        LETTER_VALUES: plot_letter_values(systems, limit, where),
        SOLVED: plot_solved(systems, limit, where),
    }


def outcomes(trials: Sequence[Trial], limit: float) -> list[Outcomes]:
    """What each system achieved, in the order of the table."""
    return [
        _outcomes([trial for trial in trials if trial.system == system], limit)
        for system in dict.fromkeys(trial.system for trial in trials)
    ]


def _outcomes(trials: Sequence[Trial], limit: float) -> Outcomes:
    name = trials[0].system
    guide, planner = _parts(name)
    return Outcomes(
        name=name,
        colour=_COLOURS.get(guide, _UNGUIDED),
        dashes=_DASHES.get(planner, "-"),
        seconds=counted_seconds(trials, limit),
        vertices=np.array([trial.vertices for trial in trials], np.float64),
        solved=np.array([trial.solved for trial in trials]),
    )


def _parts(system: str) -> tuple[str, str]:
    """Guide and planner of a system; both are the whole name where it has no guide."""
    bare, _, variant = system.partition(" (")  # F.E.), S.E.), refined) or not refined)
    guide, dash, planner = bare.partition("-")
    if not dash or guide not in _COLOURS:
        return f"({variant}" if variant else bare, bare
    return f"{guide} ({variant}" if variant else guide, planner


def _limit(folder: Path) -> float:
    try:
        return float(read_summary(folder)["settings"]["seconds"])
    except (KeyError, TypeError, ValueError) as error:
        raise InvalidResults(f"{folder} holds no results of a table: {error!r}") from error
