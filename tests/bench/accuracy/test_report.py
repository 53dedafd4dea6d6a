from __future__ import annotations

import gzip

import pytest

from planformer.bench import AccuracySettings, run_accuracy
from planformer.bench.accuracy.record import Record
from planformer.bench.accuracy.report import COLUMNS, markdown
from planformer.bench.records import from_csv


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


def test_sessions_that_are_alike_are_told_once(summary):
    other = {**summary["sessions"][0], "date": "2001-02-03"}
    twice = {**summary, "sessions": [*summary["sessions"] * 2, other]}
    lines = markdown(twice).splitlines()
    assert [line for line in lines if line not in markdown(summary).splitlines()] == [
        line for line in lines if "2001-02-03" in line
    ]
    assert sum("OMPL" in line for line in lines) == 2


def test_all_records_are_kept(summary, tmp_path):
    packed = (tmp_path / "out" / "problems.csv.gz").read_bytes()
    assert [r.problem for r in from_csv(gzip.decompress(packed).decode(), Record)] == [0, 1]
