"""What a data set consists of: the settings that determine it, kept beside its shards."""

from __future__ import annotations

import dataclasses
import json
import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from planformer.data.recipe import GENERATORS
from planformer.errors import InvalidDataset, InvalidParameter
from planformer.files import whole_file

MANIFEST = "dataset.json"
FORMAT = 1
"""Version of the manifest and the shards; raised when older readers would misread them."""


@dataclass(frozen=True)
class DatasetSpec:
    """The settings that determine a data set of expert paths on generated maps.

    Attributes:
        kinds: Kinds of maps, names in `planformer.data.recipe.GENERATORS`; kept sorted.
        maps: Number of maps of each kind.
        paths_per_map: Number of problems on each map.
        seed: Seed of the data set, >= 0.
        size: Extent of a map along x and y in metres.
        resolution: Side of a cell in metres.
        robot_radius: Radius of the robot in metres.
        min_distance: Least straight-line distance from start to goal in metres.
        maps_per_shard: Number of maps in a file; fewer in the last one of a kind.

    Raises:
        InvalidParameter: A value is out of range or a kind is unknown.
    """

    kinds: tuple[str, ...]
    maps: int
    paths_per_map: int
    seed: int
    size: float = 24.0
    resolution: float = 0.05
    robot_radius: float = 0.1
    min_distance: float = 3.0
    maps_per_shard: int = 50

    def __post_init__(self) -> None:
        object.__setattr__(self, "kinds", _checked_kinds(self.kinds))
        for name, rule, holds in (
            ("maps", "an integer >= 1", _is_integer(self.maps, 1)),
            ("paths_per_map", "an integer >= 1", _is_integer(self.paths_per_map, 1)),
            ("seed", "an integer >= 0", _is_integer(self.seed, 0)),
            ("maps_per_shard", "an integer >= 1", _is_integer(self.maps_per_shard, 1)),
            ("size", "finite and > 0 m", 0.0 < self.size < math.inf),
            ("resolution", "finite and > 0 m", 0.0 < self.resolution < math.inf),
            ("robot_radius", "finite and >= 0 m", 0.0 <= self.robot_radius < math.inf),
            ("min_distance", "finite and >= 0 m", 0.0 <= self.min_distance < math.inf),
        ):
            if not holds:
                raise InvalidParameter(f"{name} must be {rule}; got {getattr(self, name)!r}")

    def shards(self) -> dict[str, tuple[str, range]]:
        """Kind and map indices by file name of every shard."""
        step = self.maps_per_shard
        return {
            f"{kind}-{number:05d}.npz": (kind, range(first, min(first + step, self.maps)))
            for kind in self.kinds
            for number, first in enumerate(range(0, self.maps, step))
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
        raise InvalidDataset(f"{path} has format {version!r}; this version reads {FORMAT}")
    try:
        return DatasetSpec(**values)
    except (InvalidParameter, TypeError) as error:
        raise InvalidDataset(f"{path} is damaged: {error}") from error


def _checked_kinds(kinds: Sequence[str]) -> tuple[str, ...]:
    names = tuple(sorted(set(kinds)))
    if not names or not set(names) <= set(GENERATORS):
        raise InvalidParameter(
            f"kinds must be one or more of {', '.join(sorted(GENERATORS))}; got {kinds!r}"
        )
    return names


def _is_integer(value: object, least: int) -> bool:
    return isinstance(value, int) and value >= least
