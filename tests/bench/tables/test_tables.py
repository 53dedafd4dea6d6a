from __future__ import annotations

import dataclasses
import math

import pytest

from planformer.bench.tables import TableSettings, run_table
from planformer.bench.tables.measure import measure_problem, measure_without_deaths
from planformer.bench.tables.report import PAPER, SHORT_SYSTEMS, markdown, short_markdown
from planformer.bench.tables.summary import summarise
from planformer.bench.tables.systems import (
    CAR_SYSTEMS,
    POINT_SYSTEMS,
    GridSearch,
    GuidedPlanner,
    fingerprints,
)
from planformer.errors import InvalidParameter, InvalidResults
from planformer.files import locked

from .deaths import DeadlyMaps, WithASystemThatDies

QUICK = TableSettings(slack=1.05, seconds=60.0, systems=("MPT-RRT*", "BIT*", "Lazy Theta*"))


def test_each_system_has_a_trial_in_the_tables_order(small_row):
    for problem in (0, 1):
        trials = measure_problem(QUICK, (small_row, problem))
        assert [t.system for t in trials] == ["BIT*", "MPT-RRT*", "Lazy Theta*"]
        assert all(t.solved and t.length <= 1.05 * t.reference_length for t in trials)
        assert len({t.reference_length for t in trials}) == 1
    guided, grid = trials[1:]
    assert guided.proposal_seconds > 0.0
    assert guided.vertices > 1
    assert (grid.proposal_seconds, grid.vertices) == (0.0, 0)


def test_a_cars_systems(car_row):
    settings = TableSettings(1.2, 5.0, systems=("MPT-RRT*", "Hybrid-A*", "Corridor-RRT*"))
    trials = measure_problem(settings, (car_row, 0))
    assert [t.system for t in trials] == ["MPT-RRT*", "Corridor-RRT*", "Hybrid-A*"]
    assert trials[2].solved
    assert math.isfinite(trials[2].length)


def test_a_system_that_fails_is_a_counted_failure(small_row, monkeypatch):
    def explode(problem, seed):
        raise RuntimeError("out of\norder")

    monkeypatch.setitem(POINT_SYSTEMS, "Lazy Theta*", GridSearch(explode))
    trials = measure_problem(QUICK, (small_row, 0))
    assert [t.solved for t in trials] == [True, True, False]
    assert trials[2].cause == "RuntimeError: out of order"


def test_a_wrong_path_is_no_solution(small_row, monkeypatch):
    monkeypatch.setitem(
        POINT_SYSTEMS, "Lazy Theta*", GridSearch(lambda problem, seed: _through_walls(problem))
    )
    found = measure_problem(QUICK, (small_row, 0))[2]
    assert (found.solved, found.cause) == (False, "no path: invalid path")


def _through_walls(problem):
    import numpy as np

    corner = np.array([[-1.0, -1.0]])
    return np.concatenate([[problem.start], corner, [problem.goal]])


def test_rrtstars_own_length_can_be_the_reference(small_row):
    settings = dataclasses.replace(QUICK, reference="rrtstar", reference_seconds=0.2)
    best = measure_problem(QUICK, (small_row, 0))
    own = measure_problem(settings, (small_row, 0))
    assert own[0].reference_length >= best[0].reference_length * 0.999


def test_failures_count_at_the_limit(small_row, make_trial):
    trials = [make_trial(problem=i) for i in range(4)]
    failed = {"solved": False, "cause": "time limit", "vertices": 5000, "planning_seconds": 0.5}
    trials += [make_trial(problem=i, **failed) for i in (4, 5, 6, 7, 8)]
    (line,) = summarise(trials, [small_row], limit=2.0)
    assert line["accuracy_percent"]["value"] == pytest.approx(100 * 4 / 9)
    assert line["seconds"]["value"] == 2.0
    assert line["vertices"]["value"] == 5000
    assert line["solved_by"]["0.05"] == pytest.approx(4 / 9)
    assert line["solved_by"]["0.02"] == 0.0
    assert line["causes"] == {"time limit": 5}


def test_gains_are_ratios_of_medians_to_rrtstars(small_row, make_trial):
    slow = [make_trial(problem=i, planning_seconds=0.2 + i, vertices=400) for i in range(5)]
    fast = [make_trial("MPT-RRT*", i, planning_seconds=0.01, vertices=50) for i in range(5)]
    grid = [make_trial("Lazy Theta*", i, planning_seconds=0.01, vertices=0) for i in range(5)]
    lines = summarise([*slow, *fast, *grid], [small_row], limit=9.0)
    assert [line["system"] for line in lines] == ["RRT*", "MPT-RRT*", "Lazy Theta*"]
    assert lines[0]["seconds_gain"] is None
    assert lines[1]["seconds_gain"]["value"] == pytest.approx(2.21 / 0.02)
    assert lines[1]["seconds_gain"]["low"] < lines[1]["seconds_gain"]["high"]
    assert lines[1]["vertices_gain"] == {"value": 8.0, "low": 8.0, "high": 8.0}
    assert lines[2]["vertices_gain"] is None  # it has no tree
    assert summarise(fast, [small_row], limit=9.0)[0]["seconds_gain"] is None


def test_replaced_problems_are_told(small_row, make_trial):
    trials = [make_trial(problem=i, replaced=i) for i in range(3)]
    summary = {"sessions": [], "lines": summarise(trials, [small_row], limit=2.0)}
    assert "\n2 of these problems stand in for others" in markdown(summary)
    assert "stand in" not in short_markdown(summary)


def test_the_short_table_has_the_default_network_and_its_rivals_alone(small_row, make_trial):
    trials = [make_trial(system) for system in ("RRT*", "MPNet", "MPT-RRT*")]
    summary = {"sessions": [], "lines": summarise(trials, [small_row], limit=2.0)}
    systems = [line.split(" | ")[0] for line in short_markdown(summary).splitlines()[4:]]
    assert systems == ["| RRT*", "| MPT-RRT*"]
    assert set(SHORT_SYSTEMS) <= {*POINT_SYSTEMS, *CAR_SYSTEMS}


def test_a_grid_search_beyond_the_limit_has_no_path(small_row):
    settings = TableSettings(seconds=1e-7, systems=("Lazy Theta*",))
    (trial,) = measure_problem(settings, (small_row, 0))
    assert (trial.solved, trial.cause) == (False, "no path: time limit")


def test_a_system_that_takes_its_process_down_is_the_only_one_that_fails(small_row, tmp_path):
    settings = WithASystemThatDies(slack=1.2, seconds=60.0)
    trials = measure_without_deaths(settings, (small_row, 4), "the process died")
    assert [(t.system, t.solved) for t in trials] == [
        ("RRT*", True),
        ("dies", False),
        ("Lazy Theta*", True),
    ]
    assert trials[1].cause == "the process died with exit code -9"


def test_lost_problems_count_as_failures(small_row):
    maps = dataclasses.replace(small_row.scenes[0], maps=DeadlyMaps())
    row = dataclasses.replace(small_row, scenes=(maps,))
    trials = measure_without_deaths(QUICK, (row, 4), "the process died")
    assert [t.cause for t in trials] == ["the process died with exit code -9"] * 3
    lines = summarise(trials, [small_row], limit=2.0)
    assert all(line["seconds"]["value"] == 2.0 for line in lines)
    assert all(line["length_ratio"]["value"] is None for line in lines)


def test_a_table_is_completed_and_other_settings_are_refused(tmp_path):
    settings = TableSettings(slack=1.2, seconds=60.0, systems=("Lazy Theta*", "IRRT*"))
    first = run_table(tmp_path / "t", "table3", problems=1, settings=settings)
    rows = ["forest-360x240", "forest-480x240", "forest-560", "forest-780"]
    assert [line["row"] for line in first["lines"]] == [r for r in rows for _ in range(2)]
    assert all(line["accuracy_percent"]["value"] == 100.0 for line in first["lines"])
    text = (tmp_path / "t" / "table.md").read_text()
    assert "| 0.476 | 255 |" in text  # the paper's IRRT* on the largest maps
    again = run_table(tmp_path / "t", "table3", problems=1, settings=settings)
    assert again["lines"] == first["lines"]
    for other in ({"slack": 1.1}, {"systems": ("IRRT*",)}, {"reference": "rrtstar"}):
        changed = dataclasses.replace(settings, **other)
        with pytest.raises(InvalidResults, match=next(iter(other))):
            run_table(tmp_path / "t", "table3", problems=1, settings=changed)


def test_two_runs_in_one_folder_are_refused(tmp_path):
    settings = TableSettings(slack=1.2, seconds=60.0, systems=("Lazy Theta*",))
    with (
        locked(tmp_path, AssertionError()),
        pytest.raises(InvalidResults, match="another process measures"),
    ):
        run_table(tmp_path, "table1", problems=1, settings=settings)
    assert run_table(tmp_path, "table1", problems=1, settings=settings)["lines"]


def test_results_of_a_system_that_was_another_are_refused(tmp_path, monkeypatch):
    settings = TableSettings(slack=1.2, seconds=60.0, systems=("IRRT*",))
    run_table(tmp_path / "t", "table1", problems=1, settings=settings)
    monkeypatch.setitem(POINT_SYSTEMS, "IRRT*", GuidedPlanner("InformedRRTstar"))
    with pytest.raises(InvalidResults, match="definitions"):
        run_table(tmp_path / "t", "table1", problems=1, settings=settings)


@pytest.mark.parametrize(
    "bad",
    [
        {"slack": 0.99},
        {"slack": math.nan},
        {"seconds": 0.0},
        {"reference": "longest"},
        {"reference_seconds": math.inf},
        {"seed": -1},
        {"systems": ("RRT",)},
    ],
)
def test_bad_settings_are_refused(bad):
    with pytest.raises(InvalidParameter, match=next(iter(bad))):
        TableSettings(**bad)


def test_bad_calls_are_refused(tmp_path):
    for options, message in (
        ({"table": "table1", "problems": 0}, "problems"),
        ({"table": "table9", "problems": 1}, "table9"),
        ({"table": "table5", "problems": 1}, "real maps"),
    ):
        with pytest.raises(InvalidParameter, match=message):
            run_table(tmp_path, **options)
    settings = TableSettings(systems=("Hybrid-A*",))
    with pytest.raises(InvalidParameter, match="none of the systems"):
        run_table(tmp_path, "table1", problems=1, settings=settings)


def test_the_papers_names_are_those_of_systems():
    for row, known in PAPER.items():
        systems = CAR_SYSTEMS if row.startswith("dubins") else POINT_SYSTEMS
        assert known.keys() <= systems.keys()


def test_results_tell_the_weights_of_guides_and_learned_planners():
    prints = fingerprints(POINT_SYSTEMS.values())
    assert {*prints} == {"MPNet", "NEXT-KS", "mpt", "mpt-paper", "mpt-paper-fixed-encoding", "unet"}
    assert len(set(prints.values())) == len(prints)
    assert {*fingerprints(CAR_SYSTEMS.values())} == {"mpt-dubins"}
    assert fingerprints([POINT_SYSTEMS["RRT*"], POINT_SYSTEMS["Corridor-RRT*"]]) == {}
