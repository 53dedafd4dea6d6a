from __future__ import annotations

import json
import os
import re

import planformer as pf
from planformer.bench.environment import environment


def test_the_command_can_be_pasted(monkeypatch):
    monkeypatch.setattr("sys.argv", ["/x/planformer", "bench", "--systems", "RRT*,Lazy Theta*"])
    assert environment()["command"] == "planformer bench --systems 'RRT*,Lazy Theta*'"
    monkeypatch.setattr("sys.argv", ["benchmarks/ablation.py", "--data", "data"])
    assert environment()["command"] == "python ablation.py --data data"


def test_environment_says_what_a_reader_needs():
    facts = json.loads(json.dumps(environment()))
    assert facts["planformer"] == pf.__version__
    assert 1 <= facts["cores"] <= os.cpu_count()
    assert facts["command"]
    assert facts["cpu"]
    assert re.fullmatch(r"\d+\.\d+(\.\d+)*", facts["ompl"])
    assert re.fullmatch(r"\d{4}-\d\d-\d\d", facts["date"])
    assert facts["commit"] is None or re.fullmatch(r"[0-9a-f]{7,}\+?", facts["commit"])
