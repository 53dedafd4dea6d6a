"""What trials say: accuracy, time and vertices of each system, with intervals.

A problem that is not solved counts at the limit: with the time limit, or the time spent if that
was more, and with the vertices that the tree had by then. In JSON an infinite or missing number is
null.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from planformer.bench.rows import Row
from planformer.bench.statistics import (
    interval_of,
    median_of,
    percent_of,
    percentile_90,
    ratio_of_medians,
)
from planformer.bench.tables.record import Trial

BASELINE = "RRT*"
"""The system that the others' gains refer to, as in the paper."""
_DEADLINES = (0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0)
"""Seconds for which the share of the problems solved by then is told."""


def summarise(trials: Sequence[Trial], rows: Sequence[Row], limit: float) -> list[dict[str, Any]]:
    """A line for each row and system.

    Args:
        trials: The trials of the rows.
        rows: The rows, in the order of the lines.
        limit: Limit of the searches in seconds.

    Returns:
        JSON-compatible lines. Intervals are `{"value", "low", "high"}` with 95 % confidence.
    """
    lines = []
    for row in rows:
        of_row = [trial for trial in trials if trial.row == row.name]
        by_system = {
            system: [trial for trial in of_row if trial.system == system]
            for system in dict.fromkeys(trial.system for trial in of_row)
        }
        lines += [
            {
                "row": row.name,
                "system": system,
                **_measures(chosen, limit),
                **_gains(by_system.get(BASELINE), chosen, limit),
            }
            for system, chosen in by_system.items()
        ]
    return lines


def counted_seconds(trials: Sequence[Trial], limit: float) -> NDArray[np.float64]:
    """(N,) time of each trial in seconds; a failure's is at least the limit."""
    spent = np.array([trial.seconds for trial in trials])
    solved = np.array([trial.solved for trial in trials])
    return np.where(solved, spent, np.fmax(spent, limit))


def _gains(
    baseline: Sequence[Trial] | None, trials: Sequence[Trial], limit: float
) -> dict[str, Any]:
    """How many times the baseline's medians a system's go into; problems are drawn together."""
    if baseline is None or trials[0].system == BASELINE:
        return {"seconds_gain": None, "vertices_gain": None}
    pairs = {
        "seconds_gain": (counted_seconds(baseline, limit), counted_seconds(trials, limit)),
        "vertices_gain": (_vertices(baseline), _vertices(trials)),
    }
    return {
        name: interval_of(ratio_of_medians, *pair) if np.median(pair[1]) > 0 else None
        for name, pair in pairs.items()
    }


def _vertices(trials: Sequence[Trial]) -> NDArray[np.float64]:
    return np.array([float(trial.vertices) for trial in trials])


def _measures(trials: Sequence[Trial], limit: float) -> dict[str, Any]:
    solved = np.array([trial.solved for trial in trials])
    seconds = counted_seconds(trials, limit)
    vertices = _vertices(trials)
    ratio = np.array([trial.length / trial.reference_length for trial in trials])
    ratio[np.isnan(ratio)] = math.inf
    proposal = np.array([trial.proposal_seconds for trial in trials])
    return {
        "problems": len(trials),
        "replaced": sum(trial.replaced > 0 for trial in trials),
        "accuracy_percent": percent_of(solved),
        "found_percent": percent_of(np.isfinite(ratio)),
        "seconds": median_of(seconds),
        "seconds_p90": interval_of(percentile_90, seconds),
        "vertices": median_of(vertices),
        "vertices_p90": interval_of(percentile_90, vertices),
        "length_ratio": median_of(ratio),
        "proposal_seconds": median_of(proposal[np.isfinite(proposal)]),
        "solved_by": {
            f"{deadline:g}": float(np.mean(solved & (seconds <= deadline)))
            for deadline in _DEADLINES
        },
        "causes": dict(Counter(trial.cause for trial in trials if trial.cause)),
    }
