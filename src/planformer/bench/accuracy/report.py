"""The files of a finished benchmark: summary, table, all records."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from planformer.bench.accuracy.record import Record
from planformer.bench.accuracy.summary import summarise
from planformer.bench.reporting import (
    causes_line,
    interval_cell,
    markdown_table,
    session_lines,
    write_files,
)
from planformer.bench.rows import Row
from planformer.bench.store import ResultFolder

COLUMNS = {
    "solved %": ("solved_percent", ".1f"),
    "connected %": ("connected_percent", ".1f"),
    "region %": ("region_percent", ".1f"),
    "ideal %": ("ideal_region_percent", ".1f"),
    "region / ideal": ("region_over_ideal", ".2f"),
    "length": ("length_ratio", ".3f"),
    "length, 90 %": ("length_ratio_p90", ".3f"),
    "proposal ms": ("proposal_ms", ".0f"),
    "total ms": ("total_ms", ".0f"),
    "vertices": ("vertices", ",.0f"),
}
"""Columns of the table: the measure and its format."""
SHORT = ("solved %", "connected %", "region / ideal", "total ms", "vertices")
"""Those that fit on a terminal."""


def write_report(
    results: ResultFolder[Record], records: Sequence[Record], rows: Sequence[Row]
) -> dict[str, Any]:
    """Write summary.json, table.md and problems.csv.gz into the folder of the results.

    Returns:
        The content of summary.json.
    """
    summary = {
        "settings": results.settings,
        "sessions": results.sessions,
        "lines": summarise(records, rows),
    }
    write_files(results, records, summary, markdown(summary))
    return summary


def markdown(summary: Mapping[str, Any]) -> str:
    """The lines of a summary as a Markdown table, with how they were measured and what failed."""
    lines = summary["lines"]
    rows = (table_cells(line, COLUMNS, intervals=True) for line in lines)
    text = [markdown_table(["maps", "guide", "threshold", "problems", *COLUMNS], rows)]
    text += ["", *session_lines(summary)]
    failures = [
        f"- {line['row']}, {line['guide']}, {line['threshold']} threshold: "
        + causes_line(line["causes"])
        for line in lines
        if line["causes"]
    ]
    return "\n".join([*text, *(["", "Not solved:", ""] if failures else []), *failures]) + "\n"


def table_cells(
    line: Mapping[str, Any], columns: Mapping[str, tuple[str, str]], *, intervals: bool
) -> list[str]:
    """The cells of a line: names, number of problems and some of `COLUMNS`."""
    values = [
        interval_cell(line[measure], style, with_ends=intervals)
        for measure, style in columns.values()
    ]
    return [line["row"], line["guide"], line["threshold"], f"{line['problems']:,}", *values]
