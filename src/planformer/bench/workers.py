"""Processes that work through jobs; one that dies costs its job alone."""

from __future__ import annotations

import itertools
import traceback
from collections.abc import Callable, Generator, Iterable
from dataclasses import dataclass
from multiprocessing import get_context
from multiprocessing.connection import wait
from typing import Any, Generic, TypeVar

from planformer.processes import interrupts_left_to_parent

Job = TypeVar("Job")
Result = TypeVar("Result")

_CONTEXT = get_context("spawn")


@dataclass(frozen=True)
class Died:
    """What stands for the result of a job whose process died.

    Attributes:
        exit_code: Of the process; minus the signal's number if a signal killed it.
    """

    exit_code: int | None

    @property
    def cause(self) -> str:
        """What happened, in words."""
        return f"the process died with exit code {self.exit_code}"


def work_through(
    jobs: Iterable[Job], work: Callable[[Job], Result], workers: int
) -> Generator[tuple[Job, Result | Died], None, None]:
    """Work through jobs in processes of their own; yields each job with its result when done.

    The processes end with the generator: close it. Unlike the pools of the standard library this
    tells which job took its process down, goes on with the others in a new one, and does not wait
    for running jobs when it is closed.

    Args:
        jobs: The jobs; handed out in order. They must pickle, and so must the results.
        work: A function of a module, or a `functools.partial` of one.
        workers: Number of processes, >= 1.

    Raises:
        Exception: What `work` raised.
    """
    waiting = iter(jobs)
    staff: list[_Worker[Job, Result]] = []
    busy: dict[Any, _Worker[Job, Result]] = {}
    try:
        for job in itertools.islice(waiting, workers):
            staff.append(_Worker(work))
            busy[staff[-1].give(job)] = staff[-1]
        while busy:
            for connection in wait(list(busy)):
                worker = busy.pop(connection)
                done, result = worker.take()
                for job in itertools.islice(waiting, 1):
                    busy[worker.give(job)] = worker
                yield done, result
    finally:
        for worker in staff:
            worker.end()


class _Worker(Generic[Job, Result]):
    """A process, started with its first job and again after it has died."""

    def __init__(self, work: Callable[[Job], Result]) -> None:
        self._work = work
        self._process: Any = None

    def give(self, job: Job) -> Any:
        """Hand out a job; returns the connection on which its result will arrive."""
        if self._process is None:
            self._start()
        self._job = job
        self._connection.send(job)
        return self._connection

    def take(self) -> tuple[Job, Result | Died]:
        """The job and its result, which has arrived."""
        try:
            succeeded, result, details = self._connection.recv()
        except (EOFError, ConnectionError):
            self._process.join()
            died = Died(self._process.exitcode)
            self.end()
            return self._job, died
        if not succeeded:
            raise result from RuntimeError(details)
        return self._job, result

    def end(self) -> None:
        """End the process at once."""
        if self._process is not None:
            self._process.kill()
            self._process.join()
            self._connection.close()
            self._process = None

    def _start(self) -> None:
        self._connection, remote = _CONTEXT.Pipe()
        process = _CONTEXT.Process(target=_serve, args=(remote, self._work), daemon=True)
        with interrupts_left_to_parent():
            process.start()
            self._process = process  # before an interrupt that was held back arrives: `end` ends it
        remote.close()  # so that the pipe ends when the process does
        try:
            self._connection.recv()
        except EOFError:
            raise RuntimeError("a worker could not start; see its message above") from None


def _serve(connection: Any, work: Callable[[Any], Any]) -> None:
    """What a process does: a job after the other until the parent closes the pipe."""
    connection.send("ready")
    while True:
        try:
            job = connection.recv()
        except EOFError:
            return
        try:
            answer = (True, work(job), "")
        except Exception as error:
            answer = (False, error, f"in a worker:\n{traceback.format_exc()}")
        connection.send(answer)
