"""A table as the paper has it, with the paper's own numbers beside."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from planformer.bench.reporting import (
    causes_line,
    interval_cell,
    markdown_table,
    session_lines,
    write_files,
)
from planformer.bench.rows import Row
from planformer.bench.store import ResultFolder
from planformer.bench.tables.record import Trial
from planformer.bench.tables.summary import summarise

COLUMNS = {
    "accuracy %": ("accuracy_percent", ".1f"),
    "any path %": ("found_percent", ".1f"),
    "time s": ("seconds", ".4f"),
    "time s, 90 %": ("seconds_p90", ".4f"),
    "vertices": ("vertices", ",.0f"),
    "vertices, 90 %": ("vertices_p90", ",.0f"),
    "length": ("length_ratio", ".3f"),
    "proposal s": ("proposal_seconds", ".4f"),
    "RRT*'s time over it": ("seconds_gain", ".3g"),
    "RRT*'s vertices over it": ("vertices_gain", ".3g"),
}
"""Columns of the table: the measure and its format."""
SHORT = ("accuracy %", "time s", "vertices", "length")
"""Those that fit on a terminal."""
SHORT_SYSTEMS = (
    "RRT*",
    "IRRT*",
    "BIT*",
    "SST",
    "RRT* (refined)",
    "IRRT* (refined)",
    "BIT* (refined)",
    "MPT-RRT* (not refined)",
    "MPT-RRT*",
    "MPT-IRRT*",
    "MPT-BIT*",
    "MPT-RRT*-EE",
    "Corridor-RRT*",
    "Corridor-BIT*",
    "Lazy Theta*",
    "Hybrid-A*",
)
"""Systems of the short table: the default network and its strongest rivals."""

PAPER: Mapping[str, Mapping[str, tuple[float, float, int]]] = {
    "forest-480": {
        "RRT*": (100.0, 5.448, 3228),
        "IRRT*": (100.0, 0.425, 267),
        "BIT*": (100.0, 0.477, 819),
        "UNet-RRT*": (30.27, 0.167, 168),
        "UNet-RRT*-EE": (100.0, 2.58, 1913),
        "MPNet": (92.35, 0.296, 63),
        "MPT-RRT*": (99.40, 0.194, 233),
        "MPT-IRRT*": (99.40, 0.087, 136),
        "MPT-RRT*-EE": (100.0, 0.211, 247),
    },
    "maze-480": {
        "RRT*": (100.0, 5.364, 2042),
        "IRRT*": (100.0, 3.139, 1394),
        "BIT*": (100.0, 2.870, 2002),
        "UNet-RRT*": (21.4, 0.346, 277),
        "UNet-RRT*-EE": (100.0, 4.133, 2139),
        "MPNet": (71.76, 1.727, 1409),
        "NEXT-KS": (28.27, 3.021, 387),
        "MPT-RRT*": (99.16, 0.870, 626),
        "MPT-IRRT*": (99.16, 0.784, 566),
        "MPT-RRT*-EE": (100.0, 0.869, 585),
    },
    "forest-360x240": {
        "RRT*": (100.0, 5.926, 3660),
        "IRRT*": (100.0, 0.286, 257),
        "BIT*": (100.0, 0.625, 1069),
        "MPT-RRT* (F.E.)": (97.4, 0.265, 377),
        "MPT-IRRT* (F.E.)": (97.4, 0.062, 118),
        "MPT-RRT*": (99.20, 0.248, 354),
        "MPT-IRRT*": (99.20, 0.054, 106),
        "MPT-RRT*-EE": (100.0, 0.297, 382),
    },
    "forest-480x240": {
        "RRT*": (100.0, 6.308, 3480),
        "IRRT*": (100.0, 0.394, 291),
        "BIT*": (100.0, 0.590, 1061),
        "MPT-RRT* (F.E.)": (96.3, 0.268, 348),
        "MPT-IRRT* (F.E.)": (96.3, 0.072, 130),
        "MPT-RRT*": (98.5, 0.265, 319),
        "MPT-IRRT*": (98.5, 0.073, 131),
        "MPT-RRT*-EE": (100.0, 0.302, 362),
    },
    "forest-560": {
        "RRT*": (100.0, 6.725, 3854),
        "IRRT*": (100.0, 0.283, 203),
        "BIT*": (100.0, 0.397, 810),
        "MPT-RRT* (F.E.)": (75.6, 0.253, 262),
        "MPT-IRRT* (F.E.)": (75.6, 0.082, 101),
        "MPT-RRT*": (99.7, 0.181, 218),
        "MPT-IRRT*": (99.7, 0.083, 112),
        "MPT-RRT*-EE": (100.0, 0.217, 237),
    },
    "forest-780": {
        "RRT*": (100.0, 8.095, 4292),
        "IRRT*": (100.0, 0.476, 255),
        "BIT*": (100.0, 0.542, 974),
        "MPT-RRT* (F.E.)": (37.9, 0.274, 284),
        "MPT-IRRT* (F.E.)": (37.9, 0.095, 142),
        "MPT-RRT*": (99.5, 0.297, 241),
        "MPT-IRRT*": (99.5, 0.152, 161),
        "MPT-RRT*-EE": (100.0, 0.285, 238),
    },
    "dubins-forest-480": {
        "RRT*": (100.0, 0.357, 95),
        "SST": (100.0, 4.880, 710),
        "MPT-RRT*": (95.15, 0.176, 59),
        "MPT-RRT*-EE": (100.0, 0.197, 60),
    },
}
"""Accuracy in percent, median time in seconds and median vertices in the paper's tables I to IV."""

_PAPERS_OWN = " (S.E.)"
"""The network of the paper's MPT; its numbers stand beside ours of the default network too."""
_REPLACED = (
    "{} of these problems stand in for others, on maps without room or for which the search for a "
    "reference found no path."
)
_PAPER_COLUMNS = ("paper: accuracy %", "paper: time s", "paper: vertices")


def write_report(
    results: ResultFolder[Trial], trials: Sequence[Trial], rows: Sequence[Row], limit: float
) -> dict[str, Any]:
    """Write summary.json, table.md and problems.csv.gz into the folder of the results.

    Returns:
        The content of summary.json.
    """
    summary = {
        "settings": results.settings,
        "sessions": results.sessions,
        "lines": summarise(trials, rows, limit),
    }
    write_files(results, trials, summary, markdown(summary))
    return summary


def markdown(summary: Mapping[str, Any]) -> str:
    """A Markdown table for each row, how they were measured, and what failed."""
    lines = summary["lines"]
    parts = _tables(lines, COLUMNS, intervals=True)
    parts += session_lines(summary)
    failures = [
        f"- {line['row']}, {line['system']}: {causes_line(line['causes'])}"
        for line in lines
        if line.get("causes")
    ]
    return "\n".join([*parts, *(["", "Not solved:", ""] if failures else []), *failures]) + "\n"


def short_markdown(summary: Mapping[str, Any]) -> str:
    """A Markdown table for each row with `SHORT_SYSTEMS` and `SHORT` alone, without intervals."""
    columns = {name: COLUMNS[name] for name in SHORT}
    lines = [line for line in summary["lines"] if line["system"] in SHORT_SYSTEMS]
    return "\n".join(_tables(lines, columns, intervals=False))


def table_cells(
    line: Mapping[str, Any], columns: Mapping[str, tuple[str, str]], *, intervals: bool
) -> list[str]:
    """The cells of a line: the system and some of `COLUMNS`."""
    values = (
        interval_cell(line[measure], style, with_ends=intervals) if line[measure] else ""
        for measure, style in columns.values()
    )
    return [line["system"], *values]


def _tables(
    lines: Sequence[Mapping[str, Any]], columns: Mapping[str, tuple[str, str]], *, intervals: bool
) -> list[str]:
    """A heading and a table for each row, as paragraphs with empty lines between."""
    paragraphs = []
    for row in dict.fromkeys(line["row"] for line in lines):
        of_row = [line for line in lines if line["row"] == row]
        problems = max(line["problems"] for line in of_row)
        header = ["system", *columns, *(_PAPER_COLUMNS if row in PAPER else ())]
        cells = (
            [*table_cells(line, columns, intervals=intervals), *_paper(line)] for line in of_row
        )
        heading = f"### {row}, {problems:,} problems"
        paragraphs += [heading, "", markdown_table(header, cells), ""]
        if intervals and (replaced := max(line["replaced"] for line in of_row)):
            paragraphs += [_REPLACED.format(replaced), ""]
    return paragraphs


def _paper(line: Mapping[str, Any]) -> list[str]:
    """The paper's numbers beside a system: empty cells where it has none, none on other rows."""
    if line["row"] not in PAPER:
        return []
    system = line["system"].removesuffix(_PAPERS_OWN)
    if system not in PAPER[line["row"]]:
        return [""] * len(_PAPER_COLUMNS)
    accuracy, seconds, vertices = PAPER[line["row"]][system]
    return [f"{accuracy:g}", f"{seconds:g}", f"{vertices:,}"]
