"""What records say: shares and medians with intervals, for each row, guide and threshold.

A problem that is not solved counts: with infinite time and vertices, as it never got there, and
without a path with infinite length. In JSON an infinite or missing number is null.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import asdict
from typing import Any

import numpy as np
from numpy.typing import NDArray

from planformer.bench.accuracy.record import Record
from planformer.bench.rows import Row
from planformer.bench.statistics import (
    Interval,
    bootstrap_interval,
    percentile_90,
    ratio_of_medians,
    share_interval,
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
        "solved_percent": _share(records, lambda r: r.solved),
        "connected_percent": _share(records, lambda r: r.connected),
        "region_percent": _median(_PERCENT * share),
        "ideal_region_percent": _median(_PERCENT * ideal),
        "region_over_ideal": _interval(ratio_of_medians, share, ideal),
        "length_ratio": _median(length),
        "length_ratio_p90": _interval(percentile_90, length),
        "proposal_ms": _median(_MILLI * proposal[np.isfinite(proposal)]),
        "total_ms": _median(_MILLI * seconds),
        "total_ms_p90": _interval(percentile_90, _MILLI * seconds),
        "vertices": _median(vertices),
        "causes": dict(Counter(record.cause for record in records if record.cause)),
        "replaced": sum(record.replaced > 0 for record in records),
    }


def _share(records: Sequence[Record], holds: Callable[[Record], bool]) -> dict[str, float | None]:
    interval = share_interval(sum(map(holds, records)), len(records))
    percent = {name: _PERCENT * value for name, value in asdict(interval).items()}
    return _json(Interval(**percent))


def _median(values: NDArray[np.float64]) -> dict[str, float | None]:
    return _interval(np.median, values)


def _interval(statistic: Callable[..., Any], *columns: NDArray[np.float64]) -> dict[str, Any]:
    if len(columns[0]) == 0:
        return _json(Interval(math.nan, math.nan, math.nan))
    return _json(bootstrap_interval(statistic, *columns))


def _json(interval: Interval) -> dict[str, float | None]:
    values = asdict(interval).items()
    return {name: value if math.isfinite(value) else None for name, value in values}
