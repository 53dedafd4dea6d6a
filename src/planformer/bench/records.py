"""The table of what was measured: one record a problem and variant, stored as CSV."""

from __future__ import annotations

import csv
import dataclasses
import io
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

from planformer.errors import InvalidResults

_READERS: dict[str, Callable[[str], Any]] = {
    "str": str,
    "int": int,
    "float": float,
    "bool": {"True": True, "False": False}.__getitem__,
}
"""By the annotation of a field."""


@dataclass(frozen=True)
class Record:
    """What one variant achieved on one problem.

    Attributes:
        row: Name of the problem's row.
        problem: Its number in the row.
        scene: Name of its scene, empty where the row has one only.
        replaced: How many problems were given up before it, see `make_problem`.
        guide: The guide.
        threshold: The rule for its threshold.
        status: Why the search ended, empty if there was none.
        solved: Whether the path is at most `slack` times as long as the reference.
        cause: Why it is not solved, empty if it is.
        connected: Whether start and goal are connected inside region and free space.
        share: Share of the map inside the region, NaN if there is no region.
        ideal_share: That of the ideal region of the guide's scale.
        reference_length: Length of the best path known in metres.
        inside_length: Length of the shortest path inside the region in metres, infinite without
            one; NaN for a car, for which it is not known.
        length: Length of the path in metres, infinite without a path.
        vertices: Vertices of the search tree.
        proposal_seconds: Time of the proposal.
        planning_seconds: Time of the search.
    """

    row: str
    problem: int
    scene: str
    replaced: int
    guide: str
    threshold: str
    status: str
    solved: bool
    cause: str
    connected: bool
    share: float
    ideal_share: float
    reference_length: float
    inside_length: float
    length: float
    vertices: int
    proposal_seconds: float
    planning_seconds: float

    @property
    def seconds(self) -> float:
        """Time of proposal and search."""
        return self.proposal_seconds + self.planning_seconds


_FIELDS = dataclasses.fields(Record)


def to_csv(records: Iterable[Record]) -> str:
    """Records as CSV under a header; `from_csv` gives them back exactly."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([field.name for field in _FIELDS])
    writer.writerows(dataclasses.astuple(record) for record in records)
    return text.getvalue()


def from_csv(text: str) -> list[Record]:
    """The inverse of `to_csv`.

    Raises:
        InvalidResults: The text is no table of records.
    """
    try:
        header, *lines = csv.reader(io.StringIO(text))
        if header != [field.name for field in _FIELDS]:
            raise ValueError(f"columns {header}")
        return [_record(line) for line in lines]
    except (ValueError, KeyError, csv.Error) as error:
        raise InvalidResults(f"no table of records: {error}") from error


def _record(line: list[str]) -> Record:
    values = zip(_FIELDS, line, strict=True)
    return Record(**{field.name: _READERS[str(field.type)](text) for field, text in values})
