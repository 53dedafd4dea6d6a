from __future__ import annotations

import os
import signal
import subprocess
import sys
import textwrap
import threading
import time

import numpy as np
import pytest

import planformer as pf
from planformer.errors import InvalidParameter
from planformer.planning import CancelToken, PlanStatus, SearchLimits, search

from .conftest import DUBINS, EVERY_PLANNER, POINT, random_problem

ANYTIME = ["RRTstar", "InformedRRTstar", "SORRTstar", "BITstar", "ABITstar", "PRMstar"]


@pytest.mark.parametrize("planner", [*ANYTIME, "RRTsharp", "RRTXstatic", "LazyPRMstar"])
def test_the_target_length_is_met_and_ends_the_search(open_room, planner):
    problem = random_problem(open_room, POINT, 6)
    loose = search(problem, planner, limits=SearchLimits(60.0, target_length=1000.0), seed=1)
    limits = SearchLimits(60.0, target_length=0.5 * (loose.length + 1.02 * best_length(problem)))
    result = search(problem, planner, limits=limits, seed=1)
    assert result.status is PlanStatus.TARGET_REACHED
    assert result.length <= limits.target_length
    assert result.vertices >= loose.vertices


def best_length(problem):
    return search(problem, "RRTstar", limits=SearchLimits(60.0, max_vertices=3000), seed=1).length


def test_a_target_that_is_the_length_of_a_path_is_met_by_that_path(open_room):
    problem = random_problem(open_room, POINT, 6)
    for planner in ANYTIME:
        first = search(problem, planner, limits=SearchLimits(60.0, target_length=1e3), seed=1)
        limits = SearchLimits(60.0, target_length=first.length)
        assert search(problem, planner, limits=limits, seed=1).vertices == first.vertices


@pytest.mark.parametrize(("robot", "planner"), EVERY_PLANNER)
@pytest.mark.parametrize("vertices", [1, 40, 250])
def test_the_vertex_limit_is_met_and_hardly_exceeded(forest, robot, planner, vertices):
    problem = random_problem(forest, robot, 11)
    limits = SearchLimits(60.0, max_vertices=vertices)
    result = search(problem, planner, limits=limits, seed=2)
    if result.status is PlanStatus.VERTEX_LIMIT:
        assert result.vertices >= vertices
    else:
        assert result.status is PlanStatus.FINISHED
    # Batches of 100 samples, and what one extension or random walk adds.
    assert result.vertices <= vertices + 120


@pytest.mark.parametrize(("robot", "planner"), EVERY_PLANNER)
def test_the_time_limit_ends_the_search(maze, robot, planner):
    problem = random_problem(maze, robot, 1, apart=(4.0, 9.0))
    limits = SearchLimits(0.05, target_length=0.01)
    result = search(problem, planner, limits=limits, seed=1)
    assert result.status in (PlanStatus.TIME_LIMIT, PlanStatus.FINISHED)


@pytest.mark.parametrize(
    ("robot", "planner"),
    [*((POINT, name) for name in ANYTIME), (DUBINS, "RRTstar"), (DUBINS, "SST")],
)
def test_another_thread_cancels(maze, robot, planner):
    problem = random_problem(maze, robot, 1, apart=(4.0, 9.0))
    limits = SearchLimits(3600.0, target_length=0.01)
    token = CancelToken()
    timer = threading.Timer(0.1, token.cancel)
    timer.start()
    result = search(problem, planner, limits=limits, seed=1, cancel=token)
    timer.join()
    assert token.is_cancelled
    assert result.status is PlanStatus.CANCELLED
    assert not result.solved or pf.path_is_valid(maze, robot, result.path)


def test_a_token_that_is_cancelled_before_ends_at_once_and_all_its_searches(maze):
    problem = random_problem(maze, POINT, 1, apart=(4.0, 9.0))
    token = CancelToken()
    token.cancel()
    for _ in range(2):
        limits = SearchLimits(3600.0, target_length=0.01)
        result = search(problem, "RRTstar", limits=limits, seed=1, cancel=token)
        assert result.status is PlanStatus.CANCELLED
        assert result.vertices <= 2


def test_other_threads_run_during_a_search(maze):
    """The interpreter's lock is released."""
    problem = random_problem(maze, POINT, 1, apart=(4.0, 9.0))
    token, ticks = CancelToken(), []

    def tick():
        while len(ticks) < 50:
            ticks.append(time.perf_counter())
            time.sleep(0.001)
        token.cancel()

    thread = threading.Thread(target=tick)
    thread.start()
    limits = SearchLimits(3600.0, target_length=0.01)
    assert search(problem, "RRTstar", limits=limits, cancel=token).status is PlanStatus.CANCELLED
    thread.join()


@pytest.mark.skipif(os.name != "posix", reason="sends a POSIX signal")
@pytest.mark.parametrize("planner", ["RRTstar", "BITstar", "PRMstar"])
def test_ctrl_c_raises_keyboard_interrupt(planner):
    script = f"""
        import planformer as pf
        grid = pf.generate_maze(seed=2, width=6.675, height=6.675)
        cells = (~grid.blocked(0.1)).nonzero()
        start, goal = (grid.to_xy((cells[0][k], cells[1][k])) for k in (0, -1))
        plan, robot = pf.plan, pf.PointRobot(0.1)  # imported here: a signal would break imports
        print("ready", flush=True)
        try:
            plan(grid, robot, start, goal, planner={planner!r}, guide=None,
                 time_limit=3600.0, target_length=0.01)
        except KeyboardInterrupt:
            print("interrupted", flush=True)
    """
    process = subprocess.Popen(
        [sys.executable, "-c", textwrap.dedent(script)], stdout=subprocess.PIPE, text=True
    )
    assert process.stdout.readline() == "ready\n"
    time.sleep(0.3)
    process.send_signal(signal.SIGINT)
    output, _ = process.communicate(timeout=120)
    assert output == "interrupted\n"
    assert process.returncode == 0


@pytest.mark.parametrize(
    "limits",
    [
        {"seconds": 0.0},
        {"seconds": -1.0},
        {"seconds": np.nan},
        {"target_length": 0.0},
        {"target_length": np.nan},
        {"max_vertices": 0},
        {"max_vertices": -5},
        {"max_vertices": 10.5},
    ],
)
def test_a_limit_is_positive(limits):
    with pytest.raises(InvalidParameter, match=next(iter(limits))):
        SearchLimits(**limits)


def test_no_limit_is_a_limit_too(open_room):
    problem = random_problem(open_room, POINT, 6)
    for limits in (SearchLimits(seconds=None), SearchLimits(np.inf, np.inf, 2**70)):
        assert search(problem, "RRTConnect", limits=limits, seed=1).solved


def test_without_a_path_no_target_is_reached(maze):
    problem = random_problem(maze, POINT, 6, apart=(4.0, 12.0))
    result = search(problem, "RRTConnect", limits=SearchLimits(None, np.inf, 3), seed=1)
    assert (result.solved, result.status) == (False, PlanStatus.VERTEX_LIMIT)
