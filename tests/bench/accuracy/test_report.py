from __future__ import annotations

import gzip

import pytest

from planformer.bench import AccuracySettings, run_accuracy
from planformer.bench.accuracy.record import Record
from planformer.bench.accuracy.report import BEGIN, COLUMNS, END, markdown, update_page
from planformer.bench.records import from_csv
from planformer.errors import InvalidResults


@pytest.fixture
def summary(small_row, tmp_path):
    settings = AccuracySettings(guides=("ideal",), max_vertices=3)
    return run_accuracy(tmp_path / "out", [small_row], problems=2, settings=settings)


def test_the_table_has_every_line_and_what_failed(summary, tmp_path):
    table = (tmp_path / "out" / "table.md").read_text()
    assert table == markdown(summary)
    lines = table.splitlines()
    assert {line.count("|") for line in lines[:3]} == {5 + len(COLUMNS)}
    assert lines[2].startswith("| small | ideal | fixed | 2 | ")
    assert "∞" in lines[2]
    assert summary["sessions"][0]["commit"] is None or summary["sessions"][0]["commit"] in table
    assert "- small, ideal, fixed threshold: vertex limit 2" in lines


def test_all_records_are_kept(summary, tmp_path):
    packed = (tmp_path / "out" / "problems.csv.gz").read_bytes()
    assert [r.problem for r in from_csv(gzip.decompress(packed).decode(), Record)] == [0, 1]


def test_the_table_takes_its_place_in_a_page(tmp_path):
    page = tmp_path / "page.md"
    page.write_text(f"before\n\n{BEGIN}\n\nold\n\n{END}\n\nafter\n")
    for _ in range(2):
        update_page(page, "| new |\n")
        assert page.read_text() == f"before\n\n{BEGIN}\n\n| new |\n\n{END}\n\nafter\n"


@pytest.mark.parametrize("text", ["", f"{BEGIN}\n", f"{END}\n{BEGIN}\n", f"{BEGIN}\n{END}{END}"])
def test_a_page_without_its_markers_is_refused(tmp_path, text):
    page = tmp_path / "page.md"
    page.write_text(text)
    with pytest.raises(InvalidResults, match="must hold"):
        update_page(page, "table\n")
    assert page.read_text() == text
    with pytest.raises(InvalidResults, match="must hold"):
        update_page(tmp_path / "none.md", "table\n")
