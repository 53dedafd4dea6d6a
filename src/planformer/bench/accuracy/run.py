"""The accuracy of guides: do planners find good paths in their regions alone?

For each problem, each guide proposes a region at the fixed and at the connecting threshold; RRT*
searches there, with no sample from elsewhere, until its path is within the row's slack of the best
path known. See docs/accuracy.md.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import Any

import planformer
from planformer.bench.accuracy.measure import (
    PLANNER,
    AccuracySettings,
    lost_records,
    measure_problem,
)
from planformer.bench.accuracy.record import Record
from planformer.bench.accuracy.report import write_report
from planformer.bench.environment import machine
from planformer.bench.guides import fingerprints, variants
from planformer.bench.rows import Row, map_fingerprints
from planformer.bench.running import Progress, complete
from planformer.bench.store import ResultFolder
from planformer.errors import InvalidParameter


def run_accuracy(
    folder: str | Path,
    rows: Sequence[Row],
    *,
    problems: int,
    settings: AccuracySettings | None = None,
    workers: int = 1,
    report: Progress | None = None,
) -> dict[str, Any]:
    """Measure guides, or complete a measurement that was interrupted.

    What is measured is kept in the folder, four problems a file, and not measured again; more rows
    of generated maps and more problems can be added to a folder, anything else needs another one.
    A guide that fails is a counted failure with its cause; a process that dies is one of all guides
    on its problem. A script that calls this needs the usual ``if __name__ == "__main__":`` of
    multiprocessing.

    Args:
        folder: Where the results go: summary.json, table.md and problems.csv.gz.
        rows: What is measured, from `planformer.bench.rows.chosen_rows`.
        problems: Number of problems in each row.
        settings: How it is measured; by default the shipped weights and the ideal region.
        workers: Number of processes. Several share the cores, so times are those of a busy machine.
        report: Called with the number of problems measured and their total.

    Returns:
        The content of summary.json.

    Raises:
        InvalidParameter: A value is out of range, or no guide suits a row.
        InvalidResults: The folder holds results of other settings, or something else.
        UnknownGuide: No such weights.
    """
    settings = settings or AccuracySettings()
    _check(rows, problems, workers, settings)
    results = ResultFolder(Path(folder), _manifest(rows, settings, workers), Record)
    records = complete(
        results,
        rows,
        problems,
        partial(measure_problem, settings),
        partial(lost_records, settings),
        workers=workers,
        report=report,
    )
    return write_report(results, records, rows)


def _check(rows: Sequence[Row], problems: int, workers: int, settings: AccuracySettings) -> None:
    for name, value in (("problems", problems), ("workers", workers), ("rows", len(rows))):
        if value < 1:
            raise InvalidParameter(f"{name} must be >= 1; got {value}")
    for row in rows:
        if not variants(settings.guides, row):
            raise InvalidParameter(
                f"the guides {', '.join(settings.guides)} need headings, which the robots of the "
                f"row {row.name} do not have; choose other rows or guides"
            )


def _manifest(rows: Sequence[Row], settings: AccuracySettings, workers: int) -> dict[str, Any]:
    """All that the records depend on, rows of generated maps apart."""
    return {
        "benchmark": "accuracy",
        "planformer": planformer.__version__,
        "planner": PLANNER,
        **asdict(settings),
        "guides": fingerprints(settings.guides),
        "maps": map_fingerprints(rows),
        "workers": workers,
        **machine(),
    }
