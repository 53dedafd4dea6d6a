"""What records say: shares and medians with intervals, for each row, guide and threshold.

A problem that is not solved counts: with infinite time and vertices, as it never got there, and
without a path with infinite length. In JSON an infinite or missing number is null.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from planformer.bench.accuracy.record import Record
from planformer.bench.rows import Row
from planformer.bench.statistics import (
    interval_of,
    median_of,
    percent_of,
    percentile_90,
    ratio_of_medians,
)

_PERCENT, _MILLI = 100.0, 1e3


def summarise(records: Sequence[Record], rows: Sequence[Row]) -> list[dict[str, Any]]:
    """A line for each row, guide and threshold, then one for each group of rows.

    Args:
        records: The records of the rows.
        rows: The rows, in the order of the lines.

    Returns:
        JSON-compatible lines. Intervals are `{"value", "low", "high"}` with 95 % confidence.
    """
    members = {row.name: [row.name] for row in rows}
    for group in dict.fromkeys(row.group for row in rows if row.group):
        members[f"{group} (all)"] = [row.name for row in rows if row.group == group]
    lines = []
    for name, names in members.items():
        of_row = [record for record in records if record.row in names]
        for guide, threshold in dict.fromkeys((r.guide, r.threshold) for r in of_row):
            chosen = [r for r in of_row if (r.guide, r.threshold) == (guide, threshold)]
            line = {"row": name, "guide": guide, "threshold": threshold}
            lines.append({**line, **_measures(chosen)})
    return lines


def _measures(records: Sequence[Record]) -> dict[str, Any]:
    """The measures of the problems of one row, guide and threshold."""

    def column(value: Callable[[Record], float]) -> NDArray[np.float64]:
        return np.array([value(record) for record in records], np.float64)

    share, ideal = column(lambda r: r.share), column(lambda r: r.ideal_share)
    known = np.isfinite(share)
    share, ideal = share[known], ideal[known]
    length = column(lambda r: r.length) / column(lambda r: r.reference_length)
    length[np.isnan(length)] = math.inf  # the process died before a reference was found
    proposal = column(lambda r: r.proposal_seconds)
    seconds = column(lambda r: r.seconds if r.solved else math.inf)
    vertices = column(lambda r: r.vertices if r.solved else math.inf)
    return {
        "problems": len(records),
        "solved_percent": percent_of([r.solved for r in records]),
        "connected_percent": percent_of([r.connected for r in records]),
        "region_percent": median_of(_PERCENT * share),
        "ideal_region_percent": median_of(_PERCENT * ideal),
        "region_over_ideal": interval_of(ratio_of_medians, share, ideal),
        "length_ratio": median_of(length),
        "length_ratio_p90": interval_of(percentile_90, length),
        "proposal_ms": median_of(_MILLI * proposal[np.isfinite(proposal)]),
        "total_ms": median_of(_MILLI * seconds),
        "total_ms_p90": interval_of(percentile_90, _MILLI * seconds),
        "vertices": median_of(vertices),
        "causes": dict(Counter(record.cause for record in records if record.cause)),
        "replaced": sum(record.replaced > 0 for record in records),
    }
