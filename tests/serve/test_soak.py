"""The soak, in small: its 10,000 requests take minutes."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

SCRIPT = Path(__file__).resolve().parents[2] / "benchmarks" / "serve_soak.py"


def test_no_request_is_lost_and_every_search_ends(tmp_path):
    output = tmp_path / "soak.json"
    command = [sys.executable, SCRIPT, "--requests", "150", "--clients", "6", "--output", output]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    result = json.loads(output.read_text())["result"]
    assert (result["lost"], result["first_lost"]) == (0, [])
    answered = sum(count for kind, count in result["answers"].items() if "429" not in kind)
    assert answered == 150
    assert result["searches"] > 50
