"""Maps of the ROS map_server: a YAML file beside a picture, read as Nav2 reads them."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from planformer.errors import InvalidMap
from planformer.files import write_files
from planformer.maps._files import PathLike, naming, read_bytes
from planformer.maps.grid import OccupancyGrid
from planformer.maps.image import Picture, read_picture

_DEEPEST = 8
"""Collections within each other in a map file; its own are two."""
_LONGEST = 2000
"""Characters of a value in a map file; Python prints no integer of more than twice as many."""
MODES = ("trinary", "scale", "raw")
_REQUIRED = ("image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh")

# What the saver writes. 205 is 19.6 % dark: just above the free threshold, so unknown.
_OCCUPIED_LEVEL, _UNKNOWN_LEVEL, _FREE_LEVEL = 0, 205, 254
_OCCUPIED_THRESH, _FREE_THRESH = 0.65, 0.196


@dataclass(frozen=True)
class _Metadata:
    """The checked content of a map_server YAML file."""

    image: str
    resolution: float
    origin: tuple[float, ...]
    negate: bool
    occupied_thresh: float
    free_thresh: float
    mode: str

    def __post_init__(self) -> None:
        for name in ("occupied_thresh", "free_thresh"):
            value = getattr(self, name)
            if not 0.0 <= value <= 1.0:  # also NaN
                raise InvalidMap(f"{name} must be in [0, 1]; got {value}")
        if self.free_thresh > self.occupied_thresh:
            raise InvalidMap(
                f"free_thresh must be at most occupied_thresh; got free_thresh {self.free_thresh} "
                f"and occupied_thresh {self.occupied_thresh}"
            )
        if self.mode not in MODES:
            raise InvalidMap(f"mode must be one of {', '.join(MODES)}; got {self.mode!r}")


def load_ros_map(path: PathLike, *, unknown_is_occupied: bool = True) -> OccupancyGrid:
    """Load a map_server YAML file and its picture (PGM, PNG, ...).

    Semantics of nav2_map_server: darkness above `occupied_thresh` is occupied, below `free_thresh`
    free, unknown between; mode scale spreads the darkness between the thresholds over 0 to 100 and
    mode raw takes pixel values 0 to 100 as they are, which count as in `OccupancyGrid.from_ros`.
    In mode trinary opacity is averaged with the colours, in mode scale whatever is not opaque is
    unknown. Files without a mode are trinary.

    Args:
        path: The YAML file; a relative image path starts at its folder.
        unknown_is_occupied: Whether unknown cells are obstacles.

    Returns:
        The map; the top row of the picture has the highest y.

    Raises:
        InvalidMap: A file is missing, damaged or against the rules; the message names it.
    """
    file = Path(path)
    with naming(file):
        return parse_ros_map(
            read_bytes(file),
            lambda image: read_picture(file.parent / image),
            unknown_is_occupied=unknown_is_occupied,
        )


def parse_ros_map(
    description: bytes, picture_of: Callable[[str], Picture], *, unknown_is_occupied: bool = True
) -> OccupancyGrid:
    """A map from the content of its YAML file; see `load_ros_map`.

    Args:
        description: Content of the YAML file.
        picture_of: Gives the picture that the file names.
        unknown_is_occupied: Whether unknown cells are obstacles.

    Raises:
        InvalidMap: The description is damaged or against the rules.
    """
    metadata = _parse(read_description(description))
    values = _VALUES[metadata.mode](picture_of(metadata.image), metadata)[::-1]
    return OccupancyGrid.from_ros(
        values,
        width=values.shape[1],
        height=values.shape[0],
        resolution=metadata.resolution,
        origin=metadata.origin,
        unknown_is_occupied=unknown_is_occupied,
    )


def save_ros_map(grid: OccupancyGrid, path: PathLike) -> None:
    """Save a map as a map_server YAML file and a PGM picture of the same name (mode trinary).

    Loading it again gives the same map; a cell both unknown and free needs
    `unknown_is_occupied=False` for that, because the format stores unknown alone.

    Args:
        grid: The map.
        path: The YAML file to write; the picture gets the suffix .pgm.

    Raises:
        InvalidParameter: A file cannot be written.
    """
    import yaml

    file = Path(path)
    image = file.with_suffix(".pgm")
    metadata = {
        "image": image.name,
        "mode": "trinary",
        "resolution": grid.resolution,
        "origin": list(grid.origin),
        "negate": 0,
        "occupied_thresh": _OCCUPIED_THRESH,
        "free_thresh": _FREE_THRESH,
    }
    text = yaml.safe_dump(metadata, sort_keys=False, default_flow_style=None, allow_unicode=True)
    write_files({image: _encode_pgm(grid), file: text.encode()})


def _encode_pgm(grid: OccupancyGrid) -> bytes:
    levels = np.where(grid.occupied, _OCCUPIED_LEVEL, _FREE_LEVEL).astype(np.uint8)
    levels[grid.unknown] = _UNKNOWN_LEVEL
    rows, columns = grid.shape
    return f"P5\n{columns} {rows}\n255\n".encode() + levels[::-1].tobytes()


def read_description(data: bytes) -> Mapping[Any, Any]:
    """The content of a map's YAML file, of which only the syntax has been checked.

    Raises:
        InvalidMap: It is no plain YAML mapping.
    """
    import yaml

    try:
        is_plain = _is_plain(data)
        content = yaml.safe_load(data) if is_plain else None
    except (
        yaml.YAMLError,
        ArithmeticError,
        AttributeError,
        LookupError,
        RecursionError,
        ValueError,
    ) as error:
        # PyYAML lets errors of its conversions through: "!!bool x", "!!int ''", a huge "1:0:0.5".
        raise InvalidMap(f"not valid YAML: {' '.join(str(error).split())}") from error
    if not is_plain:
        raise InvalidMap("a map file has no use for YAML aliases, deep nesting and long values")
    if not isinstance(content, Mapping):
        raise InvalidMap(f"a map file must be a YAML mapping; got {type(content).__name__}")
    return content


def _is_plain(data: bytes) -> bool:
    """Whether YAML has neither aliases nor deep nesting nor long values.

    Aliases make a small file stand for a huge value, and time grows with the square of the depth.
    """
    import yaml

    depth = 0
    for event in yaml.parse(data, yaml.SafeLoader):
        depth += isinstance(event, yaml.CollectionStartEvent)
        depth -= isinstance(event, yaml.CollectionEndEvent)
        is_long = isinstance(event, yaml.ScalarEvent) and len(event.value) > _LONGEST
        if depth > _DEEPEST or is_long or isinstance(event, yaml.AliasEvent):
            return False
    return True


def _parse(content: Mapping[Any, Any]) -> _Metadata:
    missing = [key for key in _REQUIRED if key not in content]
    if missing:
        raise InvalidMap(f"missing {', '.join(missing)}; a map needs {', '.join(_REQUIRED)}")
    image, origin = content["image"], content["origin"]
    if not isinstance(image, str) or not image:
        raise InvalidMap(f"image must be the name of a picture; got {image!r}")
    if not isinstance(origin, list) or len(origin) not in (2, 3):
        raise InvalidMap(f"origin must be a list [x, y, yaw]; got {origin!r}")
    if content["negate"] not in (0, 1):  # also False and True
        raise InvalidMap(f"negate must be 0 or 1; got {content['negate']!r}")
    return _Metadata(
        image=image,
        resolution=_number("resolution", content["resolution"]),
        origin=tuple(_number("origin", value) for value in origin),
        negate=bool(content["negate"]),
        occupied_thresh=_number("occupied_thresh", content["occupied_thresh"]),
        free_thresh=_number("free_thresh", content["free_thresh"]),
        mode=content.get("mode", "trinary"),
    )


def _number(name: str, value: object) -> float:
    """A float; also from a string, because YAML 1.1 takes 5e-2 for one."""
    if isinstance(value, (int, float, str)) and not isinstance(value, bool):
        try:
            number = float(value)
        except (ValueError, OverflowError):
            number = math.nan
        if math.isfinite(number):
            return number
    raise InvalidMap(f"{name} must be a finite number; got {value!r}")


def _darkness(picture: Picture, negate: bool, with_alpha: bool) -> NDArray[np.float64]:
    """Share of occupancy in [0, 1] before the thresholds; exact at the 8 bit levels."""
    total, full = picture.rgb_sum, 3 * picture.full
    if with_alpha and picture.alpha is not None:
        total, full = total + picture.alpha, full + picture.full
    return (total if negate else full - total) / full


def _trinary_values(picture: Picture, metadata: _Metadata) -> NDArray[np.int8]:
    darkness = _darkness(picture, metadata.negate, with_alpha=True)
    values = np.full(darkness.shape, -1, np.int8)
    values[darkness < metadata.free_thresh] = 0
    values[darkness > metadata.occupied_thresh] = 100
    return values


def _scale_values(picture: Picture, metadata: _Metadata) -> NDArray[np.int8]:
    darkness = _darkness(picture, metadata.negate, with_alpha=False)
    # Equal thresholds leave nothing to spread; 1 then only avoids 0 / 0.
    span = metadata.occupied_thresh - metadata.free_thresh or 1.0
    scaled = np.clip((darkness - metadata.free_thresh) / span, 0.0, 1.0)
    values = np.rint(100.0 * scaled).astype(np.int8)
    values[darkness > metadata.occupied_thresh] = 100
    if picture.alpha is not None:
        values[picture.alpha != picture.full] = -1
    return values


def _raw_values(picture: Picture, metadata: _Metadata) -> NDArray[np.int8]:
    del metadata  # neither thresholds nor negate apply to raw values
    levels = np.rint(picture.rgb_sum * (255.0 / (3 * picture.full)))
    return np.where(levels <= 100, levels, -1).astype(np.int8)


_VALUES = {"trinary": _trinary_values, "scale": _scale_values, "raw": _raw_values}
