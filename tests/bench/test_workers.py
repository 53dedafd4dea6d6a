from __future__ import annotations

import multiprocessing
import signal
from contextlib import closing

import pytest

from planformer.bench.workers import Died, work_through

from . import work


@pytest.fixture(autouse=True)
def no_process_is_left():
    yield
    assert not multiprocessing.active_children()


@pytest.mark.parametrize(("workers", "jobs"), [(1, 4), (2, 5), (3, 2), (1, 0)])
def test_every_job_gets_its_result(workers, jobs):
    done = dict(work_through(range(jobs), work.double, workers))
    assert done == {job: 2 * job for job in range(jobs)}


@pytest.mark.parametrize("workers", [1, 2])
@pytest.mark.parametrize("last", [3, 6])
def test_a_process_that_dies_costs_its_job_alone(workers, last):
    done = dict(work_through(range(last + 1), work.die_at_three, workers))
    assert done.pop(3) == Died(-signal.SIGKILL)
    assert done == {job: job for job in range(last + 1) if job != 3}


def test_an_error_is_the_callers():
    with pytest.raises(ValueError, match="three") as error:
        list(work_through(range(9), work.fail_at_three, 2))
    assert "fail_at_three" in str(error.value.__cause__)


def test_closing_does_not_wait_for_running_jobs():
    with closing(work_through([0.0, 1e4, 1e4], work.sleep, 2)) as results:
        assert next(results)[0] == 0.0


def test_a_function_that_processes_cannot_import_is_no_failure_of_the_jobs():
    work.__dict__["vanishing"] = vanishing = type(work.double)(
        work.double.__code__, {}, "vanishing"
    )
    vanishing.__module__, vanishing.__qualname__ = work.__name__, "vanishing"
    try:
        with pytest.raises(RuntimeError, match="could not start"):
            list(work_through([1], vanishing, 1))
    finally:
        del work.__dict__["vanishing"]
