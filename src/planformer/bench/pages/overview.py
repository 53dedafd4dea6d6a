"""The accuracy of regions in one short table: the networks on all kinds of maps."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from planformer.bench.guides import LAZY_THETA, WAVEFRONT
from planformer.bench.reporting import interval_cell, markdown_table

_HEADER = ("maps", "problems", "solved, fixed", "solved, default", "region", "ideal", "corridor")

_POINT, _CAR = ("mpt", WAVEFRONT), ("mpt-dubins", LAZY_THETA)
"""The network, and the corridor without learning that it is compared with."""

_ROWS = {
    "forest-480": ("forest 480 x 480", _POINT),
    "maze-480": ("maze 480 x 480", _POINT),
    "forest-360x240": ("forest 360 x 240", _POINT),
    "forest-480x240": ("forest 480 x 240", _POINT),
    "forest-560": ("forest 560 x 560", _POINT),
    "forest-780": ("forest 780 x 780", _POINT),
    "maze-780": ("maze 780 x 780", _POINT),
    "indoor-480": ("floor plan 480 x 480", _POINT),
    "real (all)": ("real maps", _POINT),
    "dubins-forest-480": ("Dubins car, forest 480 x 480", _CAR),
    "dubins-indoor-480": ("Dubins car, floor plan 480 x 480", _CAR),
}

_Line = Mapping[str, Any]
_Lines = dict[tuple[str, str, str], _Line]
"""Lines of summaries by row, guide and threshold."""


def overview(lines: Sequence[_Line]) -> str:
    """The rows that were measured, in Markdown.

    Args:
        lines: Lines as `planformer.bench.accuracy.summary.summarise` gives them; of those with the
            same row, guide and threshold the last one counts.
    """
    known = {(line["row"], line["guide"], line["threshold"]): line for line in lines}
    rows = [
        _cells(known, row, label, *guides)
        for row, (label, guides) in _ROWS.items()
        if (row, guides[0], "fixed") in known
    ]
    return markdown_table(_HEADER, rows)


def _cells(known: _Lines, row: str, label: str, network: str, corridor: str) -> list[str]:
    fixed, default = (known[row, network, rule] for rule in ("fixed", "connecting"))
    other = known.get((row, corridor, "fixed"))
    return [
        label,
        f"{fixed['problems']:,}",
        _percent(fixed["solved_percent"], with_ends=True),
        _percent(default["solved_percent"], with_ends=True),
        _percent(fixed["region_percent"]),
        _percent(fixed["ideal_region_percent"]),
        "" if other is None else _percent(other["region_percent"]),
    ]


def _percent(interval: Mapping[str, float | None], *, with_ends: bool = False) -> str:
    value, *ends = interval_cell(interval, ".1f", with_ends=with_ends).split(" ", 1)
    return " ".join([value, "%", *ends])
