"""Tables of records: dataclasses of strings and numbers, stored as CSV."""

from __future__ import annotations

import csv
import dataclasses
import io
from collections.abc import Callable, Iterable
from typing import Any, TypeVar

from planformer.errors import InvalidResults

T = TypeVar("T")

_READERS: dict[str, Callable[[str], Any]] = {
    "str": str,
    "int": int,
    "float": float,
    "bool": {"True": True, "False": False}.__getitem__,
}
"""By the annotation of a field."""


def to_csv(records: Iterable[Any], kind: type) -> str:
    """Records as CSV under a header; `from_csv` gives them back exactly.

    Args:
        records: Instances of the dataclass.
        kind: A dataclass whose fields are annotated as str, int, float or bool.
    """
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(_names(kind))
    writer.writerows(dataclasses.astuple(record) for record in records)
    return text.getvalue()


def from_csv(text: str, kind: type[T]) -> list[T]:
    """The inverse of `to_csv`.

    Raises:
        InvalidResults: The text is no table of records of this kind.
    """
    try:
        header, *lines = csv.reader(io.StringIO(text))
        if header != _names(kind):
            raise ValueError(f"columns {header}")
        return [_record(line, kind) for line in lines]
    except (ValueError, KeyError, csv.Error) as error:
        raise InvalidResults(f"no table of records: {error}") from error


def _names(kind: type) -> list[str]:
    return [field.name for field in dataclasses.fields(kind)]


def _record(line: list[str], kind: type[T]) -> T:
    fields = dataclasses.fields(kind)  # type: ignore[arg-type]  # a dataclass, says `to_csv`
    values = zip(fields, line, strict=True)
    return kind(**{field.name: _READERS[str(field.type)](text) for field, text in values})
