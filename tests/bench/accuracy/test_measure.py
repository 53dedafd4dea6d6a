from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from planformer.bench import AccuracySettings
from planformer.bench.accuracy import measure
from planformer.bench.accuracy.measure import lost_records, measure_problem
from planformer.bench.problems import make_problem
from planformer.data.experts import shortest_path
from planformer.errors import InvalidParameter

QUICK = AccuracySettings(guides=("mpt", "ideal", "wavefront"), max_vertices=3000)


def test_a_record_a_variant(small_row):
    records = measure_problem(QUICK, (small_row, 1))
    assert [(r.guide, r.threshold) for r in records] == [
        ("mpt", "fixed"),
        ("mpt", "connecting"),
        ("ideal", "fixed"),
        ("wavefront", "fixed"),
        ("wavefront", "connecting"),
    ]
    reference = make_problem(small_row, 1, seed=0).reference_length
    for record in records:
        assert (record.row, record.problem) == ("small", 1)
        assert record.solved == (record.length <= 1.02 * record.reference_length)
        assert record.solved == (record.cause == "")
        assert record.reference_length <= reference
        assert record.inside_length >= 0.999 * record.reference_length
        assert 0.0 < record.share <= 1.0
    ideal = records[2]
    assert ideal.solved
    assert ideal.share == ideal.ideal_share


def test_the_same_region_is_searched_once(small_row):
    settings = AccuracySettings(guides=("wavefront",), max_vertices=3000)
    pairs = [measure_problem(settings, (small_row, index)) for index in range(4)]
    same = [pair for pair in pairs if pair[0].share == pair[1].share]
    assert same
    for fixed, connecting in same:
        assert fixed.planning_seconds == connecting.planning_seconds
        assert fixed.proposal_seconds != connecting.proposal_seconds


def test_a_search_that_ends_too_early_is_a_failure_with_its_cause(small_row):
    settings = AccuracySettings(guides=("ideal",), max_vertices=1)
    (record,) = measure_problem(settings, (small_row, 0))
    assert (record.solved, record.cause) == (False, "vertex limit")


def test_a_guide_that_fails_is_a_failure_with_its_cause(small_row, broken_weights):
    settings = AccuracySettings(guides=(broken_weights, "ideal"), max_vertices=3000)
    *broken, ideal = measure_problem(settings, (small_row, 0))
    assert len(broken) == 2
    for record in broken:
        assert not record.solved
        assert record.cause.startswith("WeightsMismatch: ")
        assert record.length == math.inf
    assert ideal.solved


def test_a_shorter_path_becomes_the_reference_of_all_runs(small_row, monkeypatch):
    good = make_problem(small_row, 0, seed=0)
    grid, robot = good.problem.grid, good.problem.robot
    start, goal = good.problem.start, good.problem.goal
    corners = [(x, y) for x in (1.0, grid.width - 1.0) for y in (1.0, grid.height - 1.0)]
    over = grid.nearest_free(max(corners, key=lambda at: math.dist(at, start)), robot.radius)
    ways = [shortest_path(grid, robot.radius, *ends) for ends in ((start, over), (over, goal))]
    detour = dataclasses.replace(good, reference=np.concatenate(ways))
    assert detour.reference_length > 1.1 * good.reference_length
    monkeypatch.setattr(measure, "make_problem", lambda *_: detour)
    records = measure_problem(QUICK, (small_row, 0))
    lengths = {record.reference_length for record in records}
    assert len(lengths) == 1
    assert lengths.pop() < 0.999 * detour.reference_length


def test_a_lost_problem_counts_for_every_variant(small_row):
    records = lost_records(QUICK, (small_row, 4), "the process died")
    assert len(records) == 5
    assert {(r.problem, r.solved, r.connected, r.cause) for r in records} == {
        (4, False, False, "the process died")
    }


@pytest.mark.parametrize(
    "bad",
    [
        {"guides": ()},
        {"guides": ("mpt", "mpt")},
        {"seed": -1},
        {"seed": 2**32},
        {"seconds": 0.0},
        {"max_vertices": 0},
    ],
)
def test_bad_settings_are_refused(bad):
    with pytest.raises(InvalidParameter):
        AccuracySettings(**bad)
