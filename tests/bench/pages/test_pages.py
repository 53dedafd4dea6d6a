from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from planformer.bench.pages import block_names, filled, updated_page
from planformer.bench.statistics import percent_of
from planformer.bench.tables.summary import summarise
from planformer.errors import InvalidResults

ROOT = Path(__file__).parents[3]
PAGES = ("README.md", "docs/accuracy.md", "docs/results.md")


@pytest.mark.parametrize("page", PAGES)
def test_the_committed_pages_say_what_the_committed_results_say(page):
    text = updated_page(ROOT / page, ROOT / "benchmarks" / "results")
    assert text == (ROOT / page).read_text(), f"run: planformer bench pages {' '.join(PAGES)}"


def test_every_block_stands_on_a_page():
    texts = "".join((ROOT / page).read_text() for page in PAGES)
    used = set(re.findall(r"<!-- ([\w-]+):begin -->", texts))
    assert used <= set(block_names())
    assert {f"table{i}" for i in range(1, 6)} <= used


def test_only_what_is_between_markers_changes():
    text = (
        "before\n<!-- a:begin -->\nold\n<!-- a:end -->\nmiddle\n<!-- b:begin -->\n<!-- b:end -->\n"
    )
    new = filled(text, lambda name: f"new {name}\n")
    assert new == (
        "before\n<!-- a:begin -->\n\nnew a\n\n<!-- a:end -->\nmiddle\n"
        "<!-- b:begin -->\n\nnew b\n\n<!-- b:end -->\n"
    )
    assert filled(new, lambda name: f"new {name}\n") == new


@pytest.mark.parametrize(
    "text",
    [
        "",
        "<!-- a:begin -->\n",
        "<!-- a:end -->\n<!-- a:begin -->\n",
        "<!-- a:begin -->\n<!-- b:end -->\n",
        "<!-- a:begin -->\n<!-- a:end --><!-- a:end -->\n",
        "<!-- a:begin -->\n<!-- b:begin -->\n<!-- b:end -->\n<!-- a:end -->\n",
    ],
)
def test_wrong_markers_are_refused(text):
    with pytest.raises(InvalidResults, match="pairs of lines"):
        filled(text, lambda name: "new")


@pytest.fixture
def page(tmp_path):
    """Writes a page with a block and gives back its text with the results in it."""

    def update(name):
        file = tmp_path / "docs" / "page.md"
        file.parent.mkdir(exist_ok=True)
        file.write_text(f"<!-- {name}:begin -->\n<!-- {name}:end -->\n")
        return updated_page(file, tmp_path / "results")

    return update


def _write(folder, lines):
    session = dict.fromkeys(("command", "date", "commit", "planformer", "ompl", "cores", "cpu"), 1)
    folder.mkdir(parents=True, exist_ok=True)
    content = {"settings": {}, "sessions": [session], "lines": lines}
    (folder / "summary.json").write_text(json.dumps(content))


def test_missing_results_are_told(page):
    for name in block_names():
        assert f"\n{name}: not measured yet\n" in page(name)


def test_an_unknown_block_is_an_error_with_the_choices(page):
    with pytest.raises(InvalidResults, match=r"table9.*table1, table2"):
        page("table9")


def test_tables_stand_beside_the_papers_with_their_figures(page, tmp_path, make_table):
    folder = tmp_path / "results" / "table1"
    _write(folder, make_table("forest-480"))
    (folder / "solved-forest-480.png").touch()
    text = page("table1")
    header = next(line for line in text.splitlines() if line.startswith("| system"))
    (line,) = (line for line in text.splitlines() if line.startswith("| RRT* |"))
    assert header.count("|") == line.count("|")
    assert line.endswith("| 100 | 5.448 | 3,228 |")
    assert "100.0 [20.7, 100.0]" in line
    assert "(../results/table1/solved-forest-480.png)" in text
    assert "letter_values-forest-480.png" not in text
    short = page("table1-short")
    assert "| RRT* | 100.0 | 0.0300 | 100 | 1.010 | 100 | 5.448 | 3,228 |" in short


def test_rows_that_the_paper_lacks_have_no_columns_for_it(page, tmp_path, make_table):
    _write(tmp_path / "results" / "table5", make_table("real-depot"))
    assert "paper" not in page("table5")


@pytest.fixture
def make_table(small_row):
    """Lines of a summary with one system on one problem."""
    from dataclasses import replace

    from planformer.bench.tables.record import Trial

    def make(row):
        trial = Trial(row, 0, "", 0, "RRT*", "", True, "", 10.0, 10.1, 100, 0.01, 0.02)
        return summarise([trial], [replace(small_row, name=row)], 2.0)

    return make


def test_the_later_result_of_a_row_counts_in_the_overview(page, tmp_path):
    def line(guide, threshold, solved):
        share = percent_of([True] * solved + [False] * (10 - solved))
        half = {"value": 50.0, "low": 40.0, "high": 60.0}
        names = {"row": "maze-480", "guide": guide, "threshold": threshold, "problems": 10}
        return {**names, "solved_percent": share} | dict.fromkeys(
            ("region_percent", "ideal_region_percent"), half
        )

    rules = ("fixed", "connecting")
    accuracy = tmp_path / "results" / "accuracy"
    corridor = [line("mpt", r, 1) for r in rules] + [line("wavefront", "fixed", 1)]
    _write(accuracy / "corridor", corridor)
    _write(accuracy / "maze", [line("mpt", r, 2) for r in rules])
    _write(accuracy / "point", [line("mpt", r, 10) for r in rules])
    expected = "100.0 % [72.2, 100.0] | 100.0 % [72.2, 100.0] | 50.0 % | 50.0 % | 50.0 % |"
    assert f"| maze 480 x 480 | 10 | {expected}" in page("accuracy-short")


def test_results_of_another_kind_are_refused(page, tmp_path):
    _write(tmp_path / "results" / "accuracy" / "point", [{"row": "forest-480"}])
    for name in ("accuracy-point", "accuracy-short"):
        with pytest.raises(InvalidResults, match="another kind"):
            page(name)
