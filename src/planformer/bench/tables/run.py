"""Measure the systems of a table on its rows, or complete what was interrupted."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict
from functools import partial
from pathlib import Path
from types import MappingProxyType
from typing import Any

import planformer
from planformer.bench.environment import machine
from planformer.bench.rows import REAL, SCENARIOS, Row, all_rows, map_fingerprints
from planformer.bench.running import Progress, complete
from planformer.bench.store import ResultFolder
from planformer.bench.tables.figures import write_figures
from planformer.bench.tables.measure import (
    TableSettings,
    measure_problem,
    measure_without_deaths,
)
from planformer.bench.tables.record import Trial
from planformer.bench.tables.report import write_report
from planformer.bench.tables.systems import definitions, fingerprints
from planformer.errors import InvalidParameter

TABLES: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "table1": ("forest-480",),
        "table2": ("maze-480",),
        "table3": ("forest-360x240", "forest-480x240", "forest-560", "forest-780"),
        "table4": ("dubins-forest-480",),
        "table5": (),  # real maps and scenarios, whose rows come with their folder
    }
)
"""The rows of each table: the paper's four, and real maps with problems of two kinds."""


def run_table(
    folder: str | Path,
    table: str,
    *,
    problems: int,
    settings: TableSettings | None = None,
    real_maps: Path | None = None,
    workers: int = 1,
    report: Progress | None = None,
) -> dict[str, Any]:
    """Measure the systems of a table, or complete a measurement that was interrupted.

    What is measured is kept in the folder, four problems a file, and not measured again; more
    problems can be added, anything else needs another folder. A system that fails, or takes its
    process down, is a counted failure with its cause. A script that calls this needs the usual
    ``if __name__ == "__main__":`` of multiprocessing.

    Args:
        folder: Where the results go: summary.json, table.md, problems.csv.gz, and figures of each
            row as PNG and SVG.
        table: A name in `TABLES`.
        problems: Number of problems in each row.
        settings: How it is measured.
        real_maps: Folder of the real maps, for table5.
        workers: Number of processes. Several share the cores, so times are those of a busy machine.
        report: Called with the number of problems measured and their total.

    Returns:
        The content of summary.json.

    Raises:
        InvalidParameter: A value is out of range, or the folder of real maps is missing.
        InvalidResults: The folder holds results of other settings, or something else.
    """
    settings = settings or TableSettings()
    for name, value in (("problems", problems), ("workers", workers)):
        if value < 1:
            raise InvalidParameter(f"{name} must be >= 1; got {value}")
    rows = table_rows(table, real_maps)
    if not any(settings.systems_of(row) for row in rows):
        raise InvalidParameter(f"{table} has none of the systems {settings.systems}")
    results = ResultFolder(Path(folder), _manifest(table, rows, settings, workers), Trial)
    trials = complete(
        results,
        rows,
        problems,
        partial(measure_problem, settings),
        partial(measure_without_deaths, settings),
        workers=workers,
        report=report,
    )
    summary = write_report(results, trials, rows, settings.seconds)
    write_figures(results.path)
    return summary


def table_rows(table: str, real_maps: Path | None = None) -> list[Row]:
    """The rows of a table.

    Raises:
        InvalidParameter: No table has the name, or the folder of real maps is missing or lacks one.
    """
    if table not in TABLES:
        raise InvalidParameter(f"unknown table {table!r}; choose from {', '.join(TABLES)}")
    if table == "table5" and real_maps is None:
        raise InvalidParameter(f"{table} needs the folder of the real maps")
    rows = all_rows(real_maps)
    if table == "table5":
        return [row for row in rows.values() if row.group in (REAL, SCENARIOS)]
    return [rows[name] for name in TABLES[table]]


def _manifest(
    table: str, rows: Sequence[Row], settings: TableSettings, workers: int
) -> dict[str, Any]:
    """All that the trials depend on."""
    systems = {name: its for row in rows for name, its in settings.systems_of(row).items()}
    return {
        "benchmark": table,
        "planformer": planformer.__version__,
        **asdict(settings),
        "definitions": definitions(systems),
        "weights": fingerprints(systems.values()),
        "maps": map_fingerprints(rows),
        "workers": workers,
        **machine(),
    }
