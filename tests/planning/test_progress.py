from __future__ import annotations

import threading
import time

import numpy as np
import pytest

import planformer as pf
from planformer.errors import InvalidParameter
from planformer.geometry import polyline_length
from planformer.planning import CancelToken, Progress, SearchLimits, search

from .conftest import DUBINS, EVERY_PLANNER, POINT, REEDS_SHEPP, random_problem

TELLS_OF_PATHS = [
    *((POINT, name) for name in ("RRTstar", "RRTsharp", "RRTXstatic", "InformedRRTstar")),
    *((POINT, name) for name in ("SORRTstar", "BITstar", "ABITstar", "AITstar", "PRMstar")),
    *((DUBINS, name) for name in ("RRTstar", "BITstar")),
    (REEDS_SHEPP, "RRTstar"),
]


def watched(problem, planner, *, enough, **options):
    """All snapshots that another thread sees until `enough` of them are there."""
    progress, token = Progress(interval=0.01, **options), CancelToken()
    snapshots = []

    def watch():
        while not enough(snapshots):
            latest = progress.latest()
            if latest is not None and (not snapshots or latest.seconds > snapshots[-1].seconds):
                snapshots.append(latest)
            time.sleep(0.001)
        token.cancel()

    watcher = threading.Thread(target=watch)
    watcher.start()
    limits = SearchLimits(3600.0, target_length=0.01)
    search(problem, planner, limits=limits, seed=3, cancel=token, progress=progress)
    watcher.join()
    return snapshots


@pytest.mark.parametrize(("robot", "planner"), EVERY_PLANNER)
def test_snapshots_do_not_change_the_result(open_room, robot, planner):
    problem = random_problem(open_room, robot, 6)
    options = {"limits": SearchLimits(60.0, max_vertices=150), "seed": 1, "keep_tree": True}
    without = search(problem, planner, **options)
    progress = Progress(interval=1e-6, keep_tree=True)
    observed = search(problem, planner, **options, progress=progress)
    assert np.array_equal(observed.path, without.path)
    assert np.array_equal(observed.tree.vertices, without.tree.vertices)
    assert observed.vertices == without.vertices


@pytest.mark.parametrize(("robot", "planner"), TELLS_OF_PATHS)
def test_the_best_path_is_whole_and_valid_and_gets_no_longer(open_room, robot, planner):
    problem = random_problem(open_room, robot, 6)
    snapshots = watched(
        problem,
        planner,
        enough=lambda seen: len(seen) >= 3 and len(seen[-1].path) > 0,
    )
    found = [snapshot for snapshot in snapshots if len(snapshot.path)]
    for snapshot in found:
        ends = snapshot.path[[0, -1]]
        assert np.allclose(ends, [problem.start, problem.goal], atol=1e-9)
        assert pf.path_is_valid(problem.grid, robot, snapshot.path)
        assert snapshot.length == pytest.approx(polyline_length(snapshot.path), rel=2e-3)
    lengths = [snapshot.length for snapshot in snapshots]
    assert lengths == sorted(lengths, reverse=True)
    assert all(snapshot.tree is None for snapshot in snapshots)


@pytest.mark.parametrize(
    ("robot", "planner"), [(POINT, "RRTstar"), (POINT, "BITstar"), (DUBINS, "RRTstar")]
)
def test_the_tree_grows_in_the_world_frame(open_room, robot, planner):
    problem = random_problem(open_room, robot, 6)
    snapshots = watched(problem, planner, enough=lambda seen: len(seen) >= 4, keep_tree=True)
    for snapshot in snapshots:
        vertices, edges = snapshot.tree.vertices, snapshot.tree.edges
        assert vertices.shape == (snapshot.vertices, robot.state_dimension)
        assert open_room.contains(vertices[:, :2]).all()
        assert (np.abs(vertices - problem.start) < 1e-9).all(axis=1).any()
        assert edges.max(initial=0) < len(vertices)
    if planner == "RRTstar":  # BIT* removes vertices that cannot help
        counts = [snapshot.vertices for snapshot in snapshots]
        assert counts == sorted(counts)
        assert counts[-1] > counts[0]


def test_there_is_nothing_to_tell_before_a_search():
    assert Progress().latest() is None


def test_a_search_that_is_over_at_once_tells_nothing(open_room):
    problem = random_problem(open_room, POINT, 6)
    progress = Progress(interval=3600.0)
    search(problem, "RRTConnect", limits=SearchLimits(60.0), seed=1, progress=progress)
    assert progress.latest() is None


def test_plan_passes_it_on(open_room):
    problem = random_problem(open_room, POINT, 6)
    progress = Progress(interval=1e-6)
    pf.plan(
        open_room,
        POINT,
        problem.start,
        problem.goal,
        guide=None,
        max_vertices=300,
        time_limit=60.0,
        progress=progress,
    )
    assert progress.latest().vertices > 1


@pytest.mark.parametrize("interval", [0.0, -1.0, float("nan"), float("inf")])
def test_an_impossible_interval_is_refused(interval):
    with pytest.raises(InvalidParameter, match="interval"):
        Progress(interval=interval)


def test_a_new_search_forgets_the_former(open_room):
    problem = random_problem(open_room, POINT, 6)
    progress = Progress(interval=1e-6)
    search(problem, "RRTstar", limits=SearchLimits(60.0, max_vertices=300), progress=progress)
    assert progress.latest() is not None
    here = pf.planning.Problem(open_room, POINT, problem.start, problem.start)
    search(here, "RRTstar", progress=progress)
    assert progress.latest() is None
