"""What a data set consists of: the settings that determine it, kept beside its shards."""

from __future__ import annotations

import dataclasses
import json
import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from planformer.data.recipe import GENERATORS, USER_KIND
from planformer.data.robot import make_robot
from planformer.errors import InvalidDataset, InvalidParameter, InvalidRobot
from planformer.files import whole_file
from planformer.robots import Robot

MANIFEST = "dataset.json"
FORMAT = 2
"""Version of the manifest and the shards; raised when older readers would misread them."""


@dataclass(frozen=True)
class DatasetSpec:
    """The settings that determine a data set of expert paths.

    Attributes:
        kinds: Kinds of generated maps, names in `planformer.data.recipe.GENERATORS`; kept sorted.
        maps: Number of generated maps of each kind.
        paths_per_map: Number of problems on each map.
        seed: Seed of the data set, >= 0.
        width: Extent of a generated map along x in metres.
        height: Extent of a generated map along y in metres.
        resolution: Side of a cell in metres, of generated maps and of map files that state none.
        robot: A name in `planformer.data.robot.ROBOTS`.
        robot_radius: Radius of the robot in metres.
        turning_radius: Radius of a car's tightest circle in metres; None for a point robot.
        min_distance: Least straight-line distance from start to goal in metres.
        max_distance: Greatest straight-line distance in metres; None = any.
        expert: Name of the expert that solves the problems, see `planformer.data.experts`.
        expert_seconds: Its time for each problem; None = its usual one.
        expert_vertices: Most states in its search tree; None = its usual number.
        maps_per_shard: Number of maps in a file; fewer in the last one of a kind.
        user_maps: Name and checksum of each of the users' own maps, in the shards' order.

    Raises:
        InvalidParameter: A value is out of range or a kind is unknown.
        InvalidRobot: A dimension of the robot is out of range.
    """

    kinds: tuple[str, ...]
    maps: int
    paths_per_map: int
    seed: int
    width: float = 24.0
    height: float = 24.0
    resolution: float = 0.05
    robot: str = "point"
    robot_radius: float = 0.1
    turning_radius: float | None = None
    min_distance: float = 3.0
    max_distance: float | None = None
    expert: str = "lazy-theta"
    expert_seconds: float | None = None
    expert_vertices: int | None = None
    maps_per_shard: int = 25
    user_maps: tuple[tuple[str, int], ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "kinds", _checked_kinds(self.kinds))
        object.__setattr__(self, "user_maps", tuple((n, int(c)) for n, c in self.user_maps))
        if not (self.kinds or self.user_maps):
            raise InvalidParameter("a data set needs kinds of generated maps or maps of your own")
        for name, rule, holds in self._rules():
            if not holds:
                raise InvalidParameter(f"{name} must be {rule}; got {getattr(self, name)!r}")
        self.make_robot()

    def _rules(self) -> list[tuple[str, str, bool]]:
        """Setting, rule in words, whether it holds."""
        least, most = self.min_distance, self.max_distance
        seconds, vertices = self.expert_seconds, self.expert_vertices
        maps = "an integer >= 1" if self.kinds else "0 without kinds of generated maps"
        return [
            ("maps", maps, _is_integer(self.maps, 0) and bool(self.maps) == bool(self.kinds)),
            ("paths_per_map", "an integer >= 1", _is_integer(self.paths_per_map, 1)),
            ("seed", "an integer >= 0", _is_integer(self.seed, 0)),
            ("maps_per_shard", "an integer >= 1", _is_integer(self.maps_per_shard, 1)),
            ("width", "finite and > 0 m", 0.0 < self.width < math.inf),
            ("height", "finite and > 0 m", 0.0 < self.height < math.inf),
            ("resolution", "finite and > 0 m", 0.0 < self.resolution < math.inf),
            ("min_distance", "finite and >= 0 m", 0.0 <= least < math.inf),
            ("max_distance", f"> {least} m (min_distance) or None", most is None or most > least),
            ("expert", "a name", isinstance(self.expert, str)),
            ("expert_seconds", "> 0 s or None", seconds is None or seconds > 0.0),
            ("expert_vertices", ">= 1 or None", vertices is None or _is_integer(vertices, 1)),
        ]

    def make_robot(self) -> Robot:
        """The robot that the paths are for."""
        return make_robot(self.robot, self.robot_radius, self.turning_radius)

    def maps_of(self, kind: str) -> int:
        """Number of maps of a kind, one of `kinds` or "user"."""
        return len(self.user_maps) if kind == USER_KIND else self.maps

    @property
    def total_maps(self) -> int:
        """Number of maps of all kinds."""
        return len(self.kinds) * self.maps + len(self.user_maps)

    def shards(self) -> dict[str, tuple[str, range]]:
        """Kind and map indices by file name of every shard."""
        step = self.maps_per_shard
        kinds = (*self.kinds, USER_KIND)
        return {
            f"{kind}-{number:05d}.parquet": (kind, range(first, min(first + step, count)))
            for kind, count in ((kind, self.maps_of(kind)) for kind in kinds)
            for number, first in enumerate(range(0, count, step))
        }


def write_spec(folder: Path, spec: DatasetSpec) -> None:
    """Write the manifest of a data set."""
    text = json.dumps({"format": FORMAT, **dataclasses.asdict(spec)}, indent=2) + "\n"
    with whole_file(folder / MANIFEST) as file:
        file.write(text.encode())


def read_spec(folder: Path) -> DatasetSpec:
    """Read the manifest of a data set.

    Raises:
        InvalidDataset: The folder has no manifest, or a damaged one or one of another version.
    """
    path = folder / MANIFEST
    try:
        values = json.loads(path.read_text(encoding="utf-8"))
        version = values.pop("format")
    except (FileNotFoundError, NotADirectoryError):
        raise InvalidDataset(f"{folder} is not a data set: it has no {MANIFEST}") from None
    except (OSError, ValueError, TypeError, AttributeError, KeyError) as error:
        raise InvalidDataset(f"{path} is damaged: {error}") from error
    if version != FORMAT:
        raise InvalidDataset(
            f"{path} has format {version!r}; this version reads {FORMAT}: generate the data set "
            "again, in another folder"
        )
    try:
        return DatasetSpec(**values)
    except (InvalidParameter, InvalidRobot, TypeError, ValueError) as error:
        raise InvalidDataset(f"{path} is damaged: {error}") from error


def differences(found: DatasetSpec, asked: DatasetSpec) -> str:
    """The settings in which two data sets differ, in words."""
    pairs = {
        field.name: (getattr(found, field.name), getattr(asked, field.name))
        for field in dataclasses.fields(DatasetSpec)
    }
    return "; ".join(
        "other maps of your own" if name == "user_maps" else f"{name} {has!r}, not {wants!r}"
        for name, (has, wants) in pairs.items()
        if has != wants
    )


def _checked_kinds(kinds: Sequence[str]) -> tuple[str, ...]:
    names = tuple(sorted(set(kinds)))
    if not set(names) <= set(GENERATORS):
        raise InvalidParameter(
            f"kinds must be some of {', '.join(sorted(GENERATORS))}; got {kinds!r}"
        )
    return names


def _is_integer(value: Any, least: int) -> bool:
    return isinstance(value, int) and value >= least
