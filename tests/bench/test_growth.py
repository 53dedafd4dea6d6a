from __future__ import annotations

import json

import pytest

from planformer.bench.growth import SYSTEMS, run_growth
from planformer.errors import InvalidParameter


def test_every_system_is_measured_at_every_size(tmp_path):
    summary = run_growth(tmp_path, problems=2, sizes=(120, 240))
    assert [(line["size"], line["system"]) for line in summary["lines"]] == [
        (size, name) for size in (120, 240) for name in SYSTEMS
    ]
    for line in summary["lines"]:
        assert line["problems"] == 2
        assert 0.0 < line["seconds"]["value"] <= 10.0
        assert (line["proposal_seconds"] is not None) == line["system"].startswith("MPT")
    assert summary["lines"][0]["memory_mb"] <= summary["lines"][-1]["memory_mb"]
    assert json.loads((tmp_path / "summary.json").read_text()) == summary
    assert "MPT-BIT*" in (tmp_path / "table.md").read_text()
    assert (tmp_path / "growth.png").stat().st_size > 10_000


@pytest.mark.parametrize("options", [{"problems": 0}, {"sizes": ()}, {"sizes": (50,)}])
def test_a_measurement_of_nothing_is_refused(tmp_path, options):
    with pytest.raises(InvalidParameter):
        run_growth(tmp_path, **options)
