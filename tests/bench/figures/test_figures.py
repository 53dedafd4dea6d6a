from __future__ import annotations

import json

import pytest

from planformer.bench.figures import FIGURES, write_plan_figures
from planformer.bench.figures.draw import draw_cars, draw_prediction, draw_sizes, draw_trees
from planformer.bench.figures.plans import known_problem, run
from planformer.bench.problems import make_problem
from planformer.bench.rows import all_rows
from planformer.bench.tables.systems import CAR_SYSTEMS, POINT_SYSTEMS, GuidedPlanner
from planformer.errors import InvalidParameter


@pytest.fixture
def known(small_row):
    return make_problem(small_row, 0, seed=0)


@pytest.fixture
def known_car(car_row):
    return make_problem(car_row, 0, seed=0)


def titles(figure):
    return [axes.texts[0].get_text() for axes in figure.axes if len(axes.texts) == 2]


def test_a_plan_keeps_its_tree_and_says_what_repeats_it(known):
    drawn = run(known, "MPT-RRT*")
    again = run(known, "MPT-RRT*")
    assert drawn.record() == again.record()
    assert drawn.result.vertices == len(drawn.result.tree.vertices)
    assert drawn.record()["length"] <= drawn.record()["target_length"]
    assert drawn.detail == f"{drawn.result.vertices:,} vertices, {drawn.result.length:.1f} m"
    json.dumps(drawn.record(), allow_nan=False)


@pytest.mark.parametrize("system", ["Lazy Theta*", "nothing"])
def test_a_system_without_a_tree_is_refused(known, system):
    with pytest.raises(InvalidParameter, match="no planner that has a tree"):
        run(known, system)


def test_each_plan_has_its_panel(known):
    plans = [run(known, system) for system in ("RRT*", "MPT-RRT*", "MPT-BIT*")]
    assert titles(draw_trees(plans, columns=2)) == ["RRT*", "MPT-RRT*", "MPT-BIT*"]
    rows, columns = known.problem.grid.shape
    assert titles(draw_sizes(plans[1:])) == [f"{columns} x {rows}"] * 2


def test_the_prediction_stands_between_truth_and_outcome(known):
    names = ["Truth", "Prediction", "Masked map and MPT-RRT*"]
    assert titles(draw_prediction([run(known, "MPT-RRT*")]))[:3] == names


def test_cars_have_headings(known_car):
    drawn = run(known_car, "MPT-RRT*")
    ellipses = draw_cars([drawn]).axes[0].collections[0]
    assert len(ellipses.get_offsets()) == drawn.result.region.selected.sum()


def test_every_figure_can_be_planned():
    for recipe in FIGURES.values():
        for row, _ in recipe.problems:
            systems = POINT_SYSTEMS if all_rows()[row].plane else CAR_SYSTEMS
            assert all(isinstance(systems[name], GuidedPlanner) for name in recipe.systems)
    assert known_problem("forest-480", 0, 0).row.name == "forest-480"


def test_figures_are_written_with_their_plans(tmp_path):
    files = write_plan_figures(tmp_path / "new", ["prediction"])
    assert [file.name for file in files] == ["prediction.png", "figures.json"]
    record = json.loads(files[-1].read_text())["prediction"]
    assert [plan["system"] for plan in record["plans"]] == ["MPT-RRT*"]
    assert record["environment"]["planformer"]


def test_what_is_noted_of_other_figures_stays(tmp_path):
    (tmp_path / "figures.json").write_text('{"cars": {"seed": 3}, "gone": {}}')
    *_, record = write_plan_figures(tmp_path, ["prediction"])
    noted = json.loads(record.read_text())
    assert noted["cars"] == {"seed": 3}
    assert [*noted] == ["cars", "prediction"]
    record.write_text("damaged")
    write_plan_figures(tmp_path, ["prediction"])
    assert [*json.loads(record.read_text())] == ["prediction"]


def test_bad_requests_are_refused(tmp_path):
    with pytest.raises(InvalidParameter, match=r"unknown figures cake; choose from trees-forest"):
        write_plan_figures(tmp_path, ["cake"])
    (tmp_path / "file").touch()
    with pytest.raises(InvalidParameter, match="cannot be made"):
        write_plan_figures(tmp_path / "file" / "folder", ["prediction"])
