"""What every benchmark does: intervals, and results with the environment they were measured in."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from planformer.bench.environment import environment
from planformer.bench.statistics import bootstrap_interval
from planformer.files import whole_file


def interval(values: np.ndarray, statistic: Callable[..., Any]) -> dict[str, float]:
    """A statistic of (N,) values with its 95 % bootstrap interval."""
    return asdict(bootstrap_interval(statistic, values))


def save_result(path: Path, settings: dict[str, Any], result: dict[str, Any]) -> None:
    """Write settings, environment and result as JSON, whole or not at all."""
    path.parent.mkdir(parents=True, exist_ok=True)
    content = {"environment": environment(), "settings": settings, "result": result}
    with whole_file(path) as file:
        file.write((json.dumps(content, indent=2) + "\n").encode())
