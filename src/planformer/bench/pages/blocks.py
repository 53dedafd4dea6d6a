"""What can stand between the markers of a page, by name.

table1          a table beside the paper's, with intervals, environment, figures; also table2, ...
table1-short    accuracy and medians beside the paper's, without intervals; also table2-short, ...
accuracy-point  the accuracy of regions for a point robot; also -corridor, -maze, -car, -real
accuracy-short  the accuracy of all rows: solved with intervals, and shares of the map
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import Any

from planformer.bench.accuracy import report as accuracy
from planformer.bench.pages.overview import overview
from planformer.bench.reporting import SUMMARY, read_summary
from planformer.bench.tables import TABLES
from planformer.bench.tables import report as tables
from planformer.bench.tables.figures import LETTER_VALUES, SOLVED
from planformer.errors import InvalidResults

NOT_MEASURED = "not measured yet"
_ACCURACY = ("corridor", "maze", "point", "car", "real")
"""Folders of the accuracy's results; where two have the same row, the later one counts."""

_FIGURES = {
    LETTER_VALUES: "time and vertices by system, as letter values",
    SOLVED: "share of the problems solved by a deadline",
}

_Block = Callable[[Path, Path], str | None]
"""Gives the Markdown from the folder of results and the folder of the page; None without them."""


def block(name: str, results: Path, page_folder: Path) -> str:
    """The Markdown of a block; where its results are not there, a line that says so.

    Args:
        name: One of `block_names`.
        results: Folder of all results: table1, table2, ..., accuracy/point, ...
        page_folder: Folder of the page, which links to figures are relative to.

    Raises:
        InvalidResults: The name is unknown, or the results are damaged.
    """
    blocks = _blocks()
    if name not in blocks:
        raise InvalidResults(f"unknown block {name!r}; choose from {', '.join(blocks)}")
    try:
        return blocks[name](results, page_folder) or f"{name}: {NOT_MEASURED}"
    except (KeyError, TypeError) as error:
        raise InvalidResults(f"the results of {name} are of another kind: {error!r}") from error


def block_names() -> list[str]:
    """The names of all blocks."""
    return list(_blocks())


def _blocks() -> dict[str, _Block]:
    return {
        **{table: partial(_table, table) for table in TABLES},
        **{f"{table}-short": partial(_short_table, table) for table in TABLES},
        **{f"accuracy-{part}": partial(_accuracy, part) for part in _ACCURACY},
        "accuracy-short": _accuracy_overview,
    }


def _table(table: str, results: Path, page_folder: Path) -> str | None:
    summary = _summary(results / table)
    if summary is None:
        return None
    pictures = _pictures(summary, results / table, page_folder)
    return "\n\n".join([tables.markdown(summary).strip(), *pictures])


def _pictures(summary: Mapping[str, Any], folder: Path, page_folder: Path) -> list[str]:
    """Links to the figures that the folder of a table holds."""
    files = [
        (f"{row}: {words}", folder / f"{figure}-{row}.png")
        for row in dict.fromkeys(line["row"] for line in summary["lines"])
        for figure, words in _FIGURES.items()
    ]
    return [
        f"![{words}]({Path(os.path.relpath(file, page_folder)).as_posix()})"
        for words, file in files
        if file.exists()
    ]


def _short_table(table: str, results: Path, page_folder: Path) -> str | None:
    del page_folder
    summary = _summary(results / table)
    return None if summary is None else tables.short_markdown(summary)


def _accuracy(part: str, results: Path, page_folder: Path) -> str | None:
    del page_folder
    summary = _summary(results / "accuracy" / part)
    return None if summary is None else accuracy.markdown(summary)


def _accuracy_overview(results: Path, page_folder: Path) -> str | None:
    del page_folder
    summaries = (_summary(results / "accuracy" / part) for part in _ACCURACY)
    lines = [line for summary in summaries if summary is not None for line in summary["lines"]]
    return overview(lines) if lines else None


def _summary(folder: Path) -> dict[str, Any] | None:
    """The summary in a folder, None where there is none."""
    return read_summary(folder) if (folder / SUMMARY).exists() else None
