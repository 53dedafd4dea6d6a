from __future__ import annotations

import json

import pytest

from planformer.bench.latency import ROWS, STAGES, run_latency
from planformer.errors import InvalidParameter, InvalidResults


def test_every_stage_of_every_row_is_timed(tmp_path):
    seen = []
    summary = run_latency(tmp_path, problems=2, report=lambda *done: seen.append(done))
    assert seen[-1] == (8, 8)
    assert [line["row"] for line in summary["lines"]] == list(ROWS)
    for line in summary["lines"]:
        for part in ("seconds", "seconds_p90"):
            assert all(line[part][stage]["value"] > 0.0 for stage in STAGES)
    assert json.loads((tmp_path / "summary.json").read_text()) == summary
    table = (tmp_path / "table.md").read_text()
    assert all(meaning in table for meaning in STAGES.values())
    assert all(f"{row}, 2 problems" in table for row in ROWS)


def test_a_measurement_of_nothing_is_refused(tmp_path):
    with pytest.raises(InvalidParameter, match="problems"):
        run_latency(tmp_path, problems=0)


def test_a_folder_that_cannot_take_the_results_is_refused_at_once(tmp_path):
    (tmp_path / "file").touch()
    (tmp_path / "bench.json").touch()
    for folder, reason in ((tmp_path / "file", "cannot be made"), (tmp_path, "another benchmark")):
        with pytest.raises(InvalidResults, match=reason):
            run_latency(folder, problems=10**9)
