"""The rows of a benchmark: kinds of maps and a robot, with what counts as solved there."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Protocol

from planformer.data.recipe import GENERATORS
from planformer.errors import InvalidParameter
from planformer.maps import OccupancyGrid, load_map
from planformer.maps.folder import picture_of
from planformer.robots import DubinsCar, PointRobot, Robot

REAL = "real"
"""Group of the rows on real maps."""
SCENARIOS = "scenarios"
"""Group of the rows with the problems of MovingAI's scenario files."""

_RESOLUTION = 0.05
_POINT = PointRobot(radius=0.1)
_CAR = DubinsCar(radius=0.2, turning_radius=0.3 / math.tan(0.5))
"""The paper's car: a wheelbase of 0.3 m and steering up to 0.5 rad."""


class MapSource(Protocol):
    """Where the maps of a scene come from."""

    def grid(self, seed: int) -> OccupancyGrid:
        """The map of a seed."""
        ...


@dataclass(frozen=True)
class GeneratedMaps:
    """Maps of a generator at 0.05 m a cell.

    Attributes:
        kind: A name in `planformer.data.recipe.GENERATORS`.
        width: Extent along x in metres.
        height: Extent along y in metres.
    """

    kind: str
    width: float
    height: float

    def grid(self, seed: int) -> OccupancyGrid:
        """Generate the map of a seed."""
        generate = GENERATORS[self.kind]
        return generate(seed, width=self.width, height=self.height, resolution=_RESOLUTION)


@dataclass(frozen=True)
class MapFile:
    """One map from a file, whatever the seed.

    Attributes:
        path: The file.
        resolution: Side of a cell in metres: a map that states its own is resampled to it, the
            cells of any other get this size.
    """

    path: Path
    resolution: float

    def grid(self, seed: int) -> OccupancyGrid:
        """Load the map; the seed does not matter."""
        return _load(self.path, self.resolution)


@lru_cache(maxsize=4)
def _load(path: Path, resolution: float) -> OccupancyGrid:
    if path.suffix == ".map":
        return load_map(path, resolution=resolution)
    return load_map(path).resampled(resolution)


@dataclass(frozen=True)
class Scene:
    """Maps and the robot on them.

    Attributes:
        name: What tells it from the other scenes of its row.
        maps: Where the maps come from.
        robot: The robot.
        scenarios: MovingAI .scen file that holds the problems; None draws random ones.
    """

    name: str
    maps: MapSource
    robot: Robot
    scenarios: Path | None = None


@dataclass(frozen=True)
class Row:
    """A set of problems that is reported as one.

    Attributes:
        name: Its name on the command line and in tables.
        scenes: Its maps and robots, which take turns map by map; all robots of one kind.
        slack: A path this many times as long as the reference counts as solved.
        seconds: Limit of a search.
        min_distance: Least straight-line distance from start to goal in metres.
        max_distance: Greatest one; None for any.
        group: Rows of one group are also reported together; None for no group.
    """

    name: str
    scenes: tuple[Scene, ...]
    slack: float = 1.02
    seconds: float = 10.0
    min_distance: float = 3.0
    max_distance: float | None = None
    group: str | None = None

    @property
    def plane(self) -> bool:
        """Whether its robots move in the plane, without a heading."""
        return self.scenes[0].robot.state_dimension == 2


def all_rows(real_maps: Path | None = None) -> dict[str, Row]:
    """Every row by its name; those on real maps need the folder that holds them.

    Raises:
        InvalidParameter: The folder lacks a map.
    """
    rows = _generated_rows()
    if real_maps is not None:
        rows += (*_real_rows(real_maps), *_scenario_rows(real_maps))
    return {row.name: row for row in rows}


def chosen_rows(names: Sequence[str] | None, real_maps: Path | None = None) -> tuple[Row, ...]:
    """Rows by their names, all by default.

    Raises:
        InvalidParameter: A name is unknown, or the folder of real maps lacks one.
    """
    rows = all_rows(real_maps)
    if unknown := [name for name in names or () if name not in rows]:
        raise InvalidParameter(
            f"unknown rows {', '.join(unknown)}; choose from {', '.join(rows)}"
            + ("" if real_maps else "; the rows on real maps need the folder of the maps")
        )
    return tuple(rows[name] for name in dict.fromkeys(names or rows))


def map_fingerprints(rows: Iterable[Row]) -> dict[str, str]:
    """The SHA-256 of the files that rows on real maps read, by name; a map's picture counts."""
    scenes = [scene for row in rows for scene in row.scenes]
    maps = {scene.maps.path for scene in scenes if isinstance(scene.maps, MapFile)}
    scenarios = {scene.scenarios for scene in scenes if scene.scenarios is not None}
    pictures = {picture for path in maps if (picture := picture_of(path)) is not None}
    files = sorted(maps | scenarios | pictures)
    return {file.name: hashlib.sha256(file.read_bytes()).hexdigest() for file in files}


def _generated_rows() -> tuple[Row, ...]:
    """The paper's maps and sizes, and floor plans; sizes in pixels of 0.05 m."""
    forests = {"480": (480, 480), "360x240": (360, 240), "480x240": (480, 240)}
    forests |= {"560": (560, 560), "780": (780, 780)}
    return (
        _point_row("forest-480", "forest", forests.pop("480")),
        _point_row("maze-480", "maze", (480, 480)),
        _point_row("indoor-480", "indoor", (480, 480)),
        *(_point_row(f"forest-{name}", "forest", size) for name, size in forests.items()),
        _point_row("maze-780", "maze", (780, 780)),
        _car_row("dubins-forest-480", "forest"),
        _car_row("dubins-indoor-480", "indoor"),
    )


def _point_row(name: str, kind: str, size: tuple[int, int]) -> Row:
    return Row(name, (Scene("", _generated(kind, size), _POINT),))


def _car_row(name: str, kind: str) -> Row:
    return Row(
        name,
        (Scene("", _generated(kind, (480, 480)), _CAR),),
        slack=1.05,
        seconds=2.0,
        min_distance=4.0,
        max_distance=15.0,
    )


def _generated(kind: str, size: tuple[int, int]) -> GeneratedMaps:
    width, height = (round(pixels * _RESOLUTION, 9) for pixels in size)
    return GeneratedMaps(kind, width, height)


_REAL_MAPS = {
    "depot.yaml": ((0.025, 0.05, 0.1), (0.1, 0.2, 0.3)),
    "tb3_sandbox.yaml": ((0.025, 0.05, 0.1), (0.1, 0.2, 0.3)),
    "mrpb_office02.yaml": ((0.025, 0.05, 0.1), (0.1, 0.2, 0.3)),
    "32room_000.map": ((0.1, 0.2), (0.1,)),  # finer cells leave doors too narrow for the robot
    "NewYork_0_512.map": ((0.05, 0.1, 0.2), (0.1,)),
    "maze512-32-0.map": ((0.05, 0.1, 0.2), (0.1,)),
}
"""Resolutions and radii in metres by file."""


def _real_rows(folder: Path) -> tuple[Row, ...]:
    """Maps of robots (Nav2, MRPB) and of the MovingAI benchmark."""
    needed = [*_REAL_MAPS, *(f"{name}.scen" for name in _REAL_MAPS if name.endswith(".map"))]
    missing = [name for name in needed if not (folder / name).is_file()]
    if missing:
        raise InvalidParameter(f"{folder} lacks the maps {', '.join(missing)}")
    return tuple(
        Row(
            f"real-{Path(name).stem}",
            tuple(_real_scenes(folder / name, resolutions, radii)),
            group=REAL,
        )
        for name, (resolutions, radii) in _REAL_MAPS.items()
    )


def _scenario_rows(folder: Path) -> tuple[Row, ...]:
    """Problems that others search the same maps for; the robot fits through any free cell."""
    robot = PointRobot(radius=0.04)
    maps = [(folder / name).resolve() for name in _REAL_MAPS if name.endswith(".map")]
    return tuple(
        Row(
            f"scenarios-{path.stem}",
            (Scene("", MapFile(path, 0.1), robot, path.with_name(f"{path.name}.scen")),),
            group=SCENARIOS,
        )
        for path in maps
    )


def _real_scenes(
    path: Path, resolutions: Sequence[float], radii: Sequence[float]
) -> Iterable[Scene]:
    for resolution in resolutions:
        for radius in radii:
            name = f"{resolution:g} m a cell, radius {radius:g} m"
            yield Scene(name, MapFile(path.resolve(), resolution), PointRobot(radius=radius))
