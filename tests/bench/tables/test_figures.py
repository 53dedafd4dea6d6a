from __future__ import annotations

import gzip
import json
import math

import pytest

from planformer.bench.records import to_csv
from planformer.bench.tables.figures import figures, outcomes, write_figures
from planformer.bench.tables.record import Trial
from planformer.bench.tables.systems import CAR_SYSTEMS, POINT_SYSTEMS
from planformer.errors import InvalidResults


@pytest.fixture
def folder(tmp_path, make_trial):
    trials = [make_trial(problem=i, row=row) for row in ("one", "two") for i in range(3)]
    (tmp_path / "problems.csv.gz").write_bytes(gzip.compress(to_csv(trials, Trial).encode()))
    (tmp_path / "summary.json").write_text(json.dumps({"settings": {"seconds": 2.0}}))
    return tmp_path


def test_each_row_has_its_figures(folder):
    files = write_figures(folder)
    names = [f"{figure}-{row}" for row in ("one", "two") for figure in ("letter_values", "solved")]
    assert [file.name for file in files] == [f"{n}.{s}" for n in names for s in ("png", "svg")]
    assert all(file.stat().st_size > 1000 for file in files)


def test_failures_count_at_the_limit(make_trial):
    trials = [
        make_trial(),
        make_trial(problem=1, solved=False, planning_seconds=0.5),
        make_trial(problem=2, solved=False, planning_seconds=math.nan),
    ]
    (system,) = outcomes(trials, limit=2.0)
    assert (system.name, system.failures) == ("RRT*", 2)
    assert system.seconds.tolist() == [pytest.approx(0.03), 2.0, 2.0]
    texts = [text.get_text() for text in figures(trials, 2.0)["letter_values"].axes[0].texts]
    assert "2 failed" in texts


def test_systems_can_be_told_apart(make_trial):
    for systems in (POINT_SYSTEMS, CAR_SYSTEMS):
        drawn = outcomes([make_trial(name) for name in systems], limit=2.0)
        assert len({(system.colour, system.dashes) for system in drawn}) == len(systems)
    styles = {s.name: s for s in outcomes([make_trial(name) for name in POINT_SYSTEMS], 2.0)}
    assert styles["MPT-RRT*"].colour == styles["MPT-BIT*"].colour != styles["RRT*"].colour
    assert styles["MPT-BIT*"].dashes == styles["BIT*"].dashes != styles["RRT*"].dashes


def test_a_row_without_trials_is_refused():
    with pytest.raises(InvalidResults, match="no system"):
        figures([], 2.0)


@pytest.mark.parametrize(
    ("file", "content"),
    [
        ("problems.csv.gz", b"text"),
        ("problems.csv.gz", gzip.compress(b"a,b\n1,2\n", mtime=0)),
        ("problems.csv.gz", None),
        ("summary.json", b"{}"),
        ("summary.json", b"[1]"),
        ("summary.json", None),
    ],
)
def test_folders_without_a_tables_results_are_refused(folder, file, content):
    (folder / file).unlink()
    if content is not None:
        (folder / file).write_bytes(content)
    with pytest.raises(InvalidResults, match=r"results|missing or damaged"):
        write_figures(folder)
