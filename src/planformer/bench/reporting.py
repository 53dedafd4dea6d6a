"""The files of a finished benchmark, and how its numbers are written in Markdown."""

from __future__ import annotations

import gzip
import json
import os
import zlib
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from planformer.bench.records import from_csv, to_csv
from planformer.bench.store import MANIFEST, Record, ResultFolder, write_text
from planformer.errors import InvalidResults
from planformer.files import make_folder, whole_file

SUMMARY, TABLE, PROBLEMS = "summary.json", "table.md", "problems.csv.gz"


def write_files(
    results: ResultFolder[Record],
    records: Sequence[Record],
    summary: Mapping[str, Any],
    table: str,
) -> None:
    """Write summary.json, table.md and problems.csv.gz into the folder of the results."""
    write_summary(results.path, summary, table)
    with whole_file(results.path / PROBLEMS) as file:
        # Without the time in it, so that the same records make the same file.
        file.write(gzip.compress(to_csv(records, results.kind).encode(), mtime=0))


def prepared_folder(folder: str | Path) -> Path:
    """A folder for results that come all at once, so that what is wrong with it shows first.

    Raises:
        InvalidResults: It cannot be made or written to, or holds results of a table.
    """
    folder = Path(folder)
    make_folder(folder, InvalidResults)
    if not os.access(folder, os.W_OK):
        raise InvalidResults(f"{folder} cannot be written to; choose another folder")
    if (folder / MANIFEST).exists() or (folder / PROBLEMS).exists():
        raise InvalidResults(f"{folder} holds results of another benchmark; choose another folder")
    return folder


def write_summary(folder: Path, summary: Mapping[str, Any], table: str) -> None:
    """Write summary.json and table.md into a folder."""
    write_text(folder / SUMMARY, json.dumps(summary, indent=2, allow_nan=False) + "\n")
    write_text(folder / TABLE, table)


def read_summary(folder: Path) -> dict[str, Any]:
    """The content of summary.json in a folder that `write_files` has written.

    Raises:
        InvalidResults: It is missing or damaged.
    """
    path = folder / SUMMARY
    try:
        return dict(json.loads(path.read_text(encoding="utf-8")))
    except (OSError, ValueError, TypeError) as error:
        raise InvalidResults(f"{path} is missing or damaged: {error}") from error


def read_records(folder: Path, kind: type[Record]) -> list[Record]:
    """The records in a folder that `write_files` has written.

    Args:
        folder: The folder.
        kind: The dataclass of the records.

    Raises:
        InvalidResults: They are missing, damaged or of another kind.
    """
    path = folder / PROBLEMS
    try:
        return from_csv(gzip.decompress(path.read_bytes()).decode(), kind)
    except (OSError, EOFError, zlib.error, ValueError) as error:  # InvalidResults is a ValueError
        raise InvalidResults(f"{path} is missing or damaged: {error}") from error


def markdown_table(header: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table in Markdown."""
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines)


def interval_cell(interval: Mapping[str, float | None], style: str, *, with_ends: bool) -> str:
    """A value, and where they differ from it the ends of its interval.

    Args:
        interval: As `planformer.bench.statistics.interval_of` gives it.
        style: Format of the numbers; null is written as infinite.
        with_ends: Whether to write the ends.
    """
    value, low, high = (
        "∞" if interval[end] is None else format(interval[end], style)
        for end in ("value", "low", "high")
    )
    return value if not with_ends or low == high == value else f"{value} [{low}, {high}]"


def millisecond_cell(interval: Mapping[str, float], style: str = ".1f") -> str:
    """A time in seconds with the ends of its interval, in milliseconds."""
    scaled = {end: 1e3 * value for end, value in interval.items()}
    return interval_cell(scaled, style, with_ends=True)


def causes_line(causes: Mapping[str, int]) -> str:
    """Why problems were not solved, and how often."""
    return ", ".join(f"{cause} {count}" for cause, count in causes.items())


def table_page(
    header: Sequence[str],
    rows: Iterable[Sequence[str]],
    summary: Mapping[str, Any],
    caption: str | None = None,
) -> str:
    """A table with its caption, and how it was measured."""
    captions = [] if caption is None else [caption, ""]
    return "\n".join([markdown_table(header, rows), "", *captions, *session_lines(summary)]) + "\n"


def session_lines(summary: Mapping[str, Any]) -> list[str]:
    """How the sessions of a summary measured, as a list in Markdown without repetitions."""
    return list(dict.fromkeys(_session_line(session) for session in summary["sessions"]))


def _session_line(session: Mapping[str, Any]) -> str:
    commit = session["commit"] or "unknown"
    return (
        f"- `{session['command']}`, {session['date']}, commit {commit}, planformer "
        f"{session['planformer']}, OMPL {session['ompl']}, {session['cores']} cores of "
        f"{session['cpu']}"
    )
