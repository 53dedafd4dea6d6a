from __future__ import annotations

import json

import pytest

from planformer.bench.throughput import TASKS, run_throughput
from planformer.errors import InvalidParameter


def test_queries_are_counted_on_one_map_and_on_many(tmp_path):
    summary = run_throughput(tmp_path, problems=20)
    lines = summary["lines"]
    assert {line["maps"] for line in lines} == {1, 2}
    assert {line["task"] for line in lines} == set(TASKS)
    for line in lines:
        assert line["queries"] == 20
        assert line["answered"] >= 18
        assert line["per_second"] > 0.0
    assert json.loads((tmp_path / "summary.json").read_text()) == summary
    assert "first path" in (tmp_path / "table.md").read_text()


def test_a_measurement_of_nothing_is_refused(tmp_path):
    with pytest.raises(InvalidParameter, match="problems"):
        run_throughput(tmp_path, problems=0)
