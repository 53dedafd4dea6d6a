"""Maps and scenarios of the MovingAI benchmarks.

Sturtevant, Benchmarks for Grid-Based Pathfinding, 2012. Format: https://movingai.com/benchmarks/formats.html
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from planformer.errors import InvalidMap
from planformer.maps._files import PathLike, naming, read_bytes
from planformer.maps.grid import OccupancyGrid

FREE_CHARACTERS = ".GS"
"""Passable terrain: ground twice, and swamp."""
OCCUPIED_CHARACTERS = "@OTW"
"""Out of bounds twice, trees and water."""

_INVALID = 2
_MEANING = np.full(256, _INVALID, np.uint8)
_MEANING[[ord(c) for c in FREE_CHARACTERS]] = 0
_MEANING[[ord(c) for c in OCCUPIED_CHARACTERS]] = 1


@dataclass(frozen=True)
class Scenario:
    """One problem of a scenario file.

    Attributes:
        bucket: Group of problems of similar length.
        map_name: The map as the file names it.
        width: Columns of the map.
        height: Rows of the map.
        start: Start cell (column, row) as in the file; row 0 is the top.
        goal: Goal cell (column, row) as in the file.
        optimal_length: Length of the shortest 8-connected path in cells, as the file says.
    """

    bucket: int
    map_name: str
    width: int
    height: int
    start: tuple[int, int]
    goal: tuple[int, int]
    optimal_length: float

    def __post_init__(self) -> None:
        for name, (column, row) in (("start", self.start), ("goal", self.goal)):
            if not (0 <= column < self.width and 0 <= row < self.height):
                raise InvalidMap(
                    f"the {name} ({column}, {row}) lies outside the "
                    f"{self.width} x {self.height} map"
                )
        if not (math.isfinite(self.optimal_length) and self.optimal_length >= 0):
            raise InvalidMap(f"the optimal length must be >= 0; got {self.optimal_length}")

    def start_and_goal(
        self, grid: OccupancyGrid
    ) -> tuple[tuple[float, float], tuple[float, float]]:
        """World points (x, y) in metres of the centres of the start and the goal cell.

        Args:
            grid: The scenario's map, as `load_movingai_map` gives it.

        Raises:
            InvalidMap: The grid has another size than the scenario's map.
        """
        if grid.shape != (self.height, self.width):
            rows, columns = grid.shape
            raise InvalidMap(
                f"the scenario is for {self.map_name}, {self.width} x {self.height} cells; "
                f"the grid has {columns} x {rows}"
            )
        cells = [(self.height - 1 - row, column) for column, row in (self.start, self.goal)]
        (x0, y0), (x1, y1) = grid.to_xy(cells).tolist()
        return (x0, y0), (x1, y1)


def load_movingai_map(path: PathLike, *, resolution: float = 0.05) -> OccupancyGrid:
    """Load a MovingAI .map file.

    Args:
        path: The file; lines may end in LF or CRLF.
        resolution: Side of a cell in metres; the format has none.

    Returns:
        The map; the top row of the file has the highest y.

    Raises:
        InvalidMap: The file is missing, damaged or truncated, or the resolution is unusable.
    """
    file = Path(path)
    with naming(file):
        return parse_movingai_map(read_bytes(file), resolution)


def parse_movingai_map(data: bytes, resolution: float) -> OccupancyGrid:
    """A map from the content of a MovingAI .map file; see `load_movingai_map`."""
    lines = [line.rstrip(b"\r") for line in data.split(b"\n")]
    body, width, height = _read_header(lines)
    return OccupancyGrid(_read_rows(lines[body:], width, height)[::-1], resolution)


def _read_header(lines: list[bytes]) -> tuple[int, int, int]:
    """Index of the first map line, columns and rows."""
    header: dict[bytes, bytes] = {}
    for index, line in enumerate(lines[:16]):
        key, _, value = line.strip().partition(b" ")
        if key == b"map" and not value:
            if b"type" not in header:
                raise InvalidMap("not a MovingAI map: the header has no line 'type octile'")
            return index + 1, _size(header, "width"), _size(header, "height")
        header[key] = value.strip()
    raise InvalidMap("not a MovingAI map: no line 'map' ends the header")


def _size(header: dict[bytes, bytes], name: str) -> int:
    value = header.get(name.encode())
    if value is None:
        raise InvalidMap(f"the header has no line '{name}'")
    if not value.isdigit() or len(value) > 9 or int(value) == 0:
        raise InvalidMap(
            f"{name} must be a whole number >= 1; got {value.decode(errors='replace')}"
        )
    return int(value)


def _read_rows(lines: list[bytes], width: int, height: int) -> NDArray[np.uint8]:
    """(H, W) of 0 and 1 in the order of the file."""
    rows = list(lines)
    while rows and not rows[-1].strip():
        rows.pop()
    if len(rows) != height:
        raise InvalidMap(f"the file has {len(rows)} rows, its header says {height}")
    for number, row in enumerate(rows):
        if len(row) != width:
            raise InvalidMap(f"row {number} has {len(row)} cells, the header says {width}")
    characters = np.frombuffer(b"".join(rows), np.uint8).reshape(height, width)
    cells = _MEANING[characters]
    if (cells == _INVALID).any():
        row, column = np.argwhere(cells == _INVALID)[0]
        raise InvalidMap(
            f"row {row}, column {column} holds {chr(characters[row, column])!r}; valid are "
            f"{FREE_CHARACTERS} (free) and {OCCUPIED_CHARACTERS} (occupied)"
        )
    return cells


def load_scenarios(path: PathLike) -> list[Scenario]:
    """Load a MovingAI .scen file.

    Args:
        path: The file, version 1.

    Returns:
        The problems in the order of the file.

    Raises:
        InvalidMap: The file is missing or a line is damaged; the message names it.
    """
    file = Path(path)
    with naming(file):
        lines = read_bytes(file).decode("utf-8", errors="replace").splitlines()
        if not lines or lines[0].split() not in (["version", "1"], ["version", "1.0"]):
            raise InvalidMap("a scenario file must begin with the line 'version 1'")
        return [
            _parse_scenario(number, line)
            for number, line in enumerate(lines[1:], start=2)
            if line.strip()
        ]


def _parse_scenario(number: int, line: str) -> Scenario:
    fields = line.split("\t") if "\t" in line else line.split()
    try:
        bucket, name, *cells, length = (field.strip() for field in fields)
        width, height, x0, y0, x1, y1 = map(int, cells)
        return Scenario(int(bucket), name, width, height, (x0, y0), (x1, y1), float(length))
    except InvalidMap as error:
        raise InvalidMap(f"line {number}: {error}") from error
    except ValueError as error:
        raise InvalidMap(
            f"line {number} must be: bucket, map, width, height, start x, start y, goal x, goal y, "
            f"optimal length; got {line!r}"
        ) from error
