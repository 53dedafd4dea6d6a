"""The accuracy of guides: do planners find good paths in their regions alone?

For each problem, each guide proposes a region at the fixed and at the connecting threshold; RRT*
searches there, with no sample from elsewhere, until its path is within the row's slack of the best
path known. See docs/accuracy.md.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import closing
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import Any

import planformer
from planformer.bench.environment import environment, machine
from planformer.bench.guides import fingerprints, variants
from planformer.bench.measure import PLANNER, AccuracySettings, lost_records, measure_problem
from planformer.bench.records import Record
from planformer.bench.report import write_report
from planformer.bench.rows import Row
from planformer.bench.store import Part, ResultFolder, parts
from planformer.bench.workers import Died, work_through
from planformer.errors import InvalidParameter

Progress = Callable[[int, int], None]


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
    and more problems can be added to a folder, anything else needs another one. A planner that
    fails, or takes its process down, is a counted failure with its cause. A script that calls this
    needs the usual ``if __name__ == "__main__":`` of multiprocessing.

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
    results = ResultFolder(Path(folder), _manifest(settings, workers))
    wanted = parts([row.name for row in rows], problems)
    _complete(results, wanted, rows, settings, workers=workers, report=report or _silent)
    records = [record for part in wanted for record in results.read(part)]
    return write_report(results, records, rows)


def _silent(done: int, total: int) -> None:
    """The progress report of a caller who wants none."""


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


def _manifest(settings: AccuracySettings, workers: int) -> dict[str, Any]:
    """All that the records depend on, the rows apart."""
    return {
        "benchmark": "accuracy",
        "planformer": planformer.__version__,
        "planner": PLANNER,
        **asdict(settings),
        "guides": fingerprints(settings.guides),
        "workers": workers,
        **machine(),
    }


def _complete(
    results: ResultFolder,
    wanted: Sequence[Part],
    rows: Sequence[Row],
    settings: AccuracySettings,
    *,
    workers: int,
    report: Progress,
) -> None:
    """Measure the parts that the folder lacks."""
    missing = [part for part in wanted if not results.has(part)]
    total = sum(len(part.problems) for part in wanted)
    done = total - sum(len(part.problems) for part in missing)
    report(done, total)
    if not missing:
        return
    results.begin(environment())
    by_name = {row.name: row for row in rows}
    jobs = [(by_name[part.row], problem) for part in missing for problem in part.problems]
    measured: dict[tuple[str, int], list[Record]] = {}
    waiting = {(part.row, problem): part for part in missing for problem in part.problems}
    work = partial(measure_problem, settings)
    with closing(work_through(jobs, work, workers)) as finished:
        for job, outcome in finished:
            key = (job[0].name, job[1])
            measured[key] = _records(settings, job, outcome)
            part = waiting[key]
            keys = [(part.row, problem) for problem in part.problems]
            if all(key in measured for key in keys):
                results.write(part, [record for key in keys for record in measured.pop(key)])
            done += 1
            report(done, total)


def _records(
    settings: AccuracySettings, job: tuple[Row, int], outcome: list[Record] | Died
) -> list[Record]:
    if isinstance(outcome, Died):
        cause = f"the process died with exit code {outcome.exit_code}"
        return lost_records(settings, job, cause)
    return outcome
