from __future__ import annotations

import pytest

from planformer.bench.tables.record import Trial


def _make_trial(system="RRT*", problem=0, **changes):
    values = {
        "row": "small",
        "problem": problem,
        "scene": "",
        "replaced": 0,
        "system": system,
        "status": "target reached",
        "solved": True,
        "cause": "",
        "reference_length": 10.0,
        "length": 10.1,
        "vertices": 100,
        "proposal_seconds": 0.01,
        "planning_seconds": 0.02,
    }
    return Trial(**{**values, **changes})


@pytest.fixture
def make_trial():
    return _make_trial
