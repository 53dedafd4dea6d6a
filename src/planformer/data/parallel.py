"""The same function on many jobs: in this process, in others, or on a Ray cluster.

Results come in the order of the jobs, and only a few jobs a worker are under way at any time.
"""

from __future__ import annotations

import os
import threading
from collections import deque
from collections.abc import Callable, Generator, Iterable
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from importlib import import_module
from multiprocessing import get_context
from multiprocessing.connection import Connection
from typing import Any, TypeVar

from planformer.errors import InvalidDataset, InvalidParameter, MissingExtra
from planformer.processes import interrupts_left_to_parent

Job = TypeVar("Job")
Result = TypeVar("Result")
Handle = TypeVar("Handle")

_JOBS_A_WORKER = 4
"""Enough that no worker waits while the oldest job, whose result is next, takes its time."""


def solved_in_order(
    function: Callable[[Job], Result],
    jobs: Iterable[Job],
    *,
    workers: int,
    ray_address: str | None = None,
) -> Generator[Result, None, None]:
    """Apply a function to jobs.

    Args:
        function: A function of a module; it and the jobs must pickle.
        jobs: The jobs.
        workers: Number of processes on this machine; 1 works in this one.
        ray_address: Ray cluster to work on instead, "auto" for the one that this machine is part
            of; "local" starts one of `workers` processes.

    Yields:
        The results in the order of the jobs. Close the generator to give up on the rest.

    Raises:
        InvalidParameter: There is no Ray cluster at the address.
        InvalidDataset: A worker was killed.
        MissingExtra: Ray is asked for and not installed.
    """
    if ray_address is not None:
        yield from _on_ray(function, jobs, ray_address, workers)
    elif workers == 1:
        yield from map(function, jobs)
    else:
        yield from _in_processes(function, jobs, workers)


def _in_order(
    submit: Callable[[Job], Handle],
    result: Callable[[Handle], Result],
    jobs: Iterable[Job],
    workers: int,
) -> Generator[Result, None, None]:
    under_way: deque[Handle] = deque()
    for job in jobs:
        under_way.append(submit(job))
        if len(under_way) >= _JOBS_A_WORKER * workers:
            yield result(under_way.popleft())
    while under_way:
        yield result(under_way.popleft())


def _in_processes(
    function: Callable[[Job], Result], jobs: Iterable[Job], workers: int
) -> Generator[Result, None, None]:
    context = get_context("spawn")
    reader, writer = context.Pipe(duplex=False)
    pool = ProcessPoolExecutor(workers, context, initializer=_end_when_closed, initargs=(reader,))

    def submit(job: Job) -> Future[Result]:
        with interrupts_left_to_parent():  # may start a worker
            return pool.submit(function, job)

    try:
        yield from _in_order(submit, Future.result, jobs, workers)
    except BrokenProcessPool as error:
        raise InvalidDataset(
            "a worker process was killed, perhaps for want of memory; finished shards are kept, "
            "and the same settings, with fewer workers, complete the data set"
        ) from error
    finally:
        writer.close()
        pool.shutdown(cancel_futures=True)
        reader.close()


def _end_when_closed(reader: Connection) -> None:
    """End this worker at once, even at work, when the other end of a pipe is closed.

    The parent closes it when nobody wants the results any more; where the parent is killed the
    system does, and the workers do not wait for jobs for ever.
    """

    def watch() -> None:
        reader.poll(None)
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()


def _on_ray(
    function: Callable[[Job], Result], jobs: Iterable[Job], address: str, workers: int
) -> Generator[Result, None, None]:
    try:
        ray: Any = import_module("ray")
    except ImportError as error:
        raise MissingExtra("ray", "cluster") from error
    with _cluster(ray, address, workers):
        remote = ray.remote(function)
        processors = max(1, int(ray.cluster_resources().get("CPU", 1)))
        try:
            yield from _in_order(remote.remote, ray.get, jobs, processors)
        except ray.exceptions.RayTaskError as error:
            raise error.cause from error
        except ray.exceptions.RayError as error:
            raise InvalidDataset(
                f"the Ray cluster failed: {error}; finished shards are kept, and the same "
                "settings complete the data set"
            ) from error


@contextmanager
def _cluster(ray: Any, address: str, workers: int) -> Generator[None, None, None]:
    """Join a Ray cluster for as long as the block runs, unless this process has joined one."""
    if ray.is_initialized():
        yield
        return
    own: dict[str, Any] = {"num_cpus": workers, "include_dashboard": False}
    try:
        ray.init(address=address, log_to_driver=False, **(own if address == "local" else {}))
    except (ConnectionError, ValueError) as error:
        raise InvalidParameter(f"no Ray cluster at {address!r}: {error}") from error
    try:
        yield
    finally:
        ray.shutdown()
