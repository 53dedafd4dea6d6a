"""Measure the problems of some rows, a part at a time, and keep what is measured."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import closing

from planformer.bench.environment import environment
from planformer.bench.rows import Row
from planformer.bench.store import Record, ResultFolder, parts
from planformer.bench.workers import Died, work_through
from planformer.errors import InvalidParameter, PlanformerError

Job = tuple[Row, int]
"""A row and the number of a problem in it."""
Progress = Callable[[int, int], None]
FAILURES = (PlanformerError, RuntimeError, ValueError, ArithmeticError, MemoryError)
"""What a guide or a planner may raise; a TypeError, say, is a mistake in the program instead."""


def in_rows(
    rows: Sequence[Row], problems: int, report: Progress | None
) -> Iterator[tuple[Row, Iterator[int]]]:
    """Each row with the numbers of its problems; a problem counts as measured at the next.

    Args:
        rows: The rows.
        problems: Number of problems in each.
        report: Called with the number of problems measured and their total.

    Raises:
        InvalidParameter: There are no problems.
    """
    if problems < 1:
        raise InvalidParameter(f"problems must be >= 1; got {problems}")

    def numbers(before: int) -> Iterator[int]:
        for index in range(problems):
            yield index
            if report:
                report(before + index + 1, len(rows) * problems)

    for number, row in enumerate(rows):
        yield row, numbers(number * problems)


def complete(
    results: ResultFolder[Record],
    rows: Sequence[Row],
    problems: int,
    measure: Callable[[Job], list[Record]],
    lost: Callable[[Job, str], list[Record]],
    *,
    workers: int = 1,
    report: Progress | None = None,
) -> list[Record]:
    """Measure the problems that a folder lacks.

    Args:
        results: The folder.
        rows: The rows.
        problems: Number of problems in each.
        measure: Gives the records of a problem; a function of a module, or a partial of one.
        lost: Gives the records of a problem whose process died of a cause.
        workers: Number of processes.
        report: Called with the number of problems measured and their total.

    Returns:
        The records of all problems, those measured before included.
    """
    by_name = {row.name: row for row in rows}
    wanted = parts(by_name, problems)
    missing = [part for part in wanted if not results.has(part)]
    total = sum(len(part.problems) for part in wanted)
    done = total - sum(len(part.problems) for part in missing)
    if report:
        report(done, total)
    jobs = [(by_name[part.row], problem) for part in missing for problem in part.problems]
    waiting = {(part.row, problem): part for part in missing for problem in part.problems}
    measured: dict[tuple[str, int], list[Record]] = {}
    with results.held(), closing(work_through(jobs, measure, workers)) as finished:
        if missing:
            results.begin(environment())
        for job, outcome in finished:
            key = (job[0].name, job[1])
            measured[key] = lost(job, outcome.cause) if isinstance(outcome, Died) else outcome
            part = waiting[key]
            keys = [(part.row, problem) for problem in part.problems]
            if all(key in measured for key in keys):
                results.write(part, [record for key in keys for record in measured.pop(key)])
            done += 1
            if report:
                report(done, total)
    return [record for part in wanted for record in results.read(part)]
