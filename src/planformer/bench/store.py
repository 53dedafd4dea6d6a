"""The folder of a benchmark: what was measured so far, and with which settings.

bench.json              the settings, and the environment of every session
parts/ROW-FIRST-COUNT.csv   the records of COUNT problems, written when all are measured
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Generic, Protocol, TypeVar

from planformer.bench.records import from_csv, to_csv
from planformer.errors import InvalidResults
from planformer.files import locked, remove_unfinished, whole_file

MANIFEST = "bench.json"
FORMAT = 2
"""Raised when the rows, what is measured, or the files change."""
_PART = 4
"""Problems in a part: what a kill can cost."""


@dataclass(frozen=True)
class Part:
    """Consecutive problems of a row that are stored together.

    Attributes:
        row: Name of the row.
        problems: Their numbers.
    """

    row: str
    problems: range

    @property
    def file(self) -> str:
        """Name of its file."""
        return f"{self.row}-{self.problems.start:06d}-{len(self.problems)}.csv"


def parts(rows: Iterable[str], problems: int) -> list[Part]:
    """The parts of some rows with a number of problems each; the rows take turns."""
    names = list(rows)
    return [
        Part(row, range(first, min(first + _PART, problems)))
        for first in range(0, problems, _PART)
        for row in names
    ]


class RowRecord(Protocol):
    """A dataclass that says which problem it is of."""

    @property
    def row(self) -> str:
        """Name of the problem's row."""

    @property
    def problem(self) -> int:
        """Its number in the row."""


Record = TypeVar("Record", bound=RowRecord)


class ResultFolder(Generic[Record]):
    """Records on disk that belong to one set of settings.

    Args:
        folder: The folder; made where it does not exist.
        settings: All that the records depend on, as JSON-compatible values.
        kind: The dataclass of the records.

    Attributes:
        path: The folder.
        kind: The dataclass of the records.

    Raises:
        InvalidResults: The folder holds results of other settings, or something else.
    """

    def __init__(self, folder: Path, settings: Mapping[str, Any], kind: type[Record]) -> None:
        self.path, self.kind = folder, kind
        # As JSON gives it back, to compare it with what was stored.
        self._settings = json.loads(json.dumps({"format": FORMAT, **settings}))
        self._parts = folder / "parts"
        _require_folder(folder)
        self._sessions = self._earlier_sessions()

    def begin(self, environment: Mapping[str, Any]) -> None:
        """Note the environment of a session that is going to measure."""
        self.path.mkdir(parents=True, exist_ok=True)
        self._sessions.append(dict(environment))
        content = {"settings": self._settings, "sessions": self._sessions}
        write_text(self.path / MANIFEST, json.dumps(content, indent=2) + "\n")
        self._parts.mkdir(exist_ok=True)

    @contextmanager
    def held(self) -> Iterator[None]:
        """Keep other processes from measuring into the folder.

        Raises:
            InvalidResults: Another one does already.
        """
        self.path.mkdir(parents=True, exist_ok=True)
        with locked(self.path, InvalidResults(f"another process measures into {self.path}")):
            remove_unfinished(self.path)
            remove_unfinished(self._parts)
            yield

    @property
    def sessions(self) -> list[dict[str, Any]]:
        """The environment of each session that measured something."""
        return list(self._sessions)

    @property
    def settings(self) -> dict[str, Any]:
        """The settings, with the format."""
        return dict(self._settings)

    def has(self, part: Part) -> bool:
        """Whether a part is measured."""
        return (self._parts / part.file).exists()

    def write(self, part: Part, records: Iterable[Record]) -> None:
        """Store a part; its file appears whole or not at all."""
        write_text(self._parts / part.file, to_csv(records, self.kind))

    def read(self, part: Part) -> list[Record]:
        """The records of a part.

        Raises:
            InvalidResults: The file is missing, damaged or of another part.
        """
        path = self._parts / part.file
        try:
            records = from_csv(path.read_text(encoding="utf-8"), self.kind)
        except (OSError, UnicodeDecodeError, InvalidResults) as error:
            raise InvalidResults(
                f"{path} is damaged ({error}); remove it to measure its problems again"
            ) from error
        if {(record.row, record.problem) for record in records} != {
            (part.row, problem) for problem in part.problems
        }:
            raise InvalidResults(f"{path} holds other problems; remove it to measure them again")
        return records

    def _earlier_sessions(self) -> list[dict[str, Any]]:
        path = self.path / MANIFEST
        if not path.exists():
            unfinished = set(self.path.glob(f".{MANIFEST}.*.tmp"))
            if self.path.exists() and set(self.path.iterdir()) - unfinished:
                raise InvalidResults(
                    f"{self.path} is neither empty nor of a benchmark; choose another folder"
                )
            return []
        found, sessions = _read_manifest(path)
        if found != self._settings:
            raise InvalidResults(
                f"{self.path} holds results of other settings: "
                f"{_difference(found, self._settings)}; choose another folder, or ask for "
                "the same settings to complete it"
            )
        return sessions


def write_text(path: Path, text: str) -> None:
    """Write a file whole or not at all."""
    with whole_file(path) as file:
        file.write(text.encode())


def _require_folder(path: Path) -> None:
    if path.exists() and not path.is_dir():
        raise InvalidResults(f"{path} is a file; choose another folder")


def _read_manifest(path: Path) -> tuple[dict[str, Any], list[dict[str, Any]]]:
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
        return dict(content["settings"]), list(content["sessions"])
    except (OSError, ValueError, TypeError, KeyError) as error:
        raise InvalidResults(f"{path} is damaged: {error!r}") from error


def _difference(found: Mapping[str, Any], asked: Mapping[str, Any]) -> str:
    """The settings that differ, in words."""
    names = [name for name in {**found, **asked} if found.get(name) != asked.get(name)]
    return ", ".join(
        f"{name} {found.get(name)!r} (asked for {asked.get(name)!r})" for name in names
    )
