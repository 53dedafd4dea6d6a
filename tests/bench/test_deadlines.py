from __future__ import annotations

import json

import pytest

from planformer.bench.deadlines import LIMITS, PLANNERS, ROWS, run_deadlines
from planformer.errors import InvalidParameter


def test_every_planner_is_measured_with_every_limit(tmp_path):
    seen = []
    summary = run_deadlines(tmp_path, problems=2, report=lambda *done: seen.append(done))
    assert seen[-1] == (4, 4)
    assert [(line["row"], line["planner"], line["limit"]) for line in summary["lines"]] == [
        (row, planner, limit) for row in ROWS for planner in PLANNERS for limit in LIMITS
    ]
    for line in summary["lines"]:
        least, middle, most = line["overrun"].values()
        assert 0.0 <= least <= middle <= most
        assert 0.0 <= line["kept_percent"] <= 100.0
    assert json.loads((tmp_path / "summary.json").read_text()) == summary
    table = (tmp_path / "table.md").read_text()
    assert table.count("\n| ") == len(summary["lines"]) + 1


def test_a_measurement_of_nothing_is_refused(tmp_path):
    with pytest.raises(InvalidParameter, match="problems"):
        run_deadlines(tmp_path, problems=0)
