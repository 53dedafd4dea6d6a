from __future__ import annotations

import dataclasses
import json
import math

import pytest

from planformer.bench.accuracy.record import Record
from planformer.bench.accuracy.summary import summarise
from planformer.bench.statistics import share_interval


def record(**changes):
    values = {
        "row": "small",
        "problem": 0,
        "scene": "",
        "replaced": 0,
        "guide": "mpt",
        "threshold": "fixed",
        "status": "target reached",
        "solved": True,
        "cause": "",
        "connected": True,
        "share": 0.1,
        "ideal_share": 0.05,
        "reference_length": 10.0,
        "inside_length": 10.0,
        "length": 10.1,
        "vertices": 100,
        "proposal_seconds": 0.03,
        "planning_seconds": 0.01,
    }
    return Record(**{**values, **changes})


FAILED = {"solved": False, "cause": "time limit", "length": math.inf, "planning_seconds": 10.0}


def test_a_line_says_what_the_records_do(small_row):
    records = [record(vertices=100 + i, length=10.0 + 0.01 * i) for i in range(9)]
    records += [record(**FAILED)]
    (line,) = summarise(records, [small_row])
    assert (line["row"], line["guide"], line["threshold"]) == ("small", "mpt", "fixed")
    assert line["problems"] == 10
    wilson = share_interval(9, 10)
    assert line["solved_percent"] == {
        "value": 90.0,
        "low": pytest.approx(100 * wilson.low),
        "high": pytest.approx(100 * wilson.high),
    }
    assert line["connected_percent"]["value"] == 100.0
    assert line["region_percent"]["value"] == pytest.approx(10.0)
    assert line["region_over_ideal"]["value"] == pytest.approx(2.0)
    assert line["length_ratio"]["value"] == pytest.approx(1.0045)
    assert line["length_ratio_p90"]["value"] == pytest.approx(1.008)
    assert line["total_ms"]["value"] == pytest.approx(40.0)
    assert line["vertices"]["value"] == 104.5
    assert line["causes"] == {"time limit": 1}


def test_failures_are_never_dropped(small_row):
    (line,) = summarise([record(), record(**FAILED), record(**FAILED)], [small_row])
    for measure in ("length_ratio", "length_ratio_p90", "total_ms", "vertices"):
        assert line[measure]["value"] is None, measure
    assert line["proposal_ms"]["value"] == pytest.approx(30.0)


def test_what_a_dead_process_leaves_unknown_is_left_out(small_row):
    unknown = dict.fromkeys(
        ("share", "ideal_share", "reference_length", "inside_length", "proposal_seconds"), math.nan
    )
    lost = record(**{**FAILED, **unknown, "cause": "the process died"})
    (line,) = summarise([record(), record(), lost], [small_row])
    assert line["region_percent"]["value"] == pytest.approx(10.0)
    assert line["length_ratio_p90"]["value"] is None
    (line,) = summarise([lost], [small_row])
    assert line["region_percent"] == {"value": None, "low": None, "high": None}
    json.dumps(line, allow_nan=False)


def test_lines_come_by_row_guide_and_threshold_and_then_by_group(small_row):
    rows = [dataclasses.replace(small_row, name=name, group="real") for name in ("a", "b")]
    records = [
        record(row=row, guide=guide, threshold=threshold)
        for row in ("b", "a")
        for guide in ("mpt", "ideal")
        for threshold in ("fixed", "connecting")
    ]
    lines = summarise(records, [*rows, small_row])
    keys = [(line["row"], line["guide"], line["threshold"]) for line in lines]
    assert keys == [
        (row, guide, threshold)
        for row in ("a", "b", "real (all)")
        for guide in ("mpt", "ideal")
        for threshold in ("fixed", "connecting")
    ]
    assert [line["problems"] for line in lines] == [1] * 8 + [2] * 4
