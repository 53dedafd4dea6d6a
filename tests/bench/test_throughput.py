from __future__ import annotations

import json

import pytest

from planformer.bench.throughput import TASKS, run_throughput
from planformer.errors import InvalidParameter


def test_the_same_queries_are_counted_on_known_maps_and_on_new_ones(tmp_path):
    summary = run_throughput(tmp_path, problems=24)
    lines = summary["lines"]
    assert {line["maps"] for line in lines} == {"known", "new"}
    assert {line["task"] for line in lines} == set(TASKS)
    for line in lines:
        assert line["queries"] == 24
        assert 22 <= line["answered"] <= 24
        rate = line["per_second"]
        assert 0.0 < rate["low"] <= rate["value"] <= rate["high"]
    assert json.loads((tmp_path / "summary.json").read_text()) == summary
    assert "first path" in (tmp_path / "table.md").read_text()


def test_a_measurement_of_nothing_is_refused(tmp_path):
    with pytest.raises(InvalidParameter, match="problems"):
        run_throughput(tmp_path, problems=0)
