"""Load and save maps of every format, chosen by the file's suffix."""

from __future__ import annotations

import io
import tokenize
import zipfile
from pathlib import Path

import numpy as np

from planformer.errors import InvalidMap, InvalidParameter
from planformer.files import write_files
from planformer.maps._files import PathLike, naming, read_bytes
from planformer.maps.grid import OccupancyGrid
from planformer.maps.image import IMAGE_SUFFIXES, encode_png, load_image_map
from planformer.maps.movingai import load_movingai_map
from planformer.maps.ros import load_ros_map, save_ros_map

DEFAULT_RESOLUTION = 0.05
YAML_SUFFIXES = (".yaml", ".yml")
LOAD_SUFFIXES = (*YAML_SUFFIXES, ".map", ".npy", *IMAGE_SUFFIXES)
SAVE_SUFFIXES = (*YAML_SUFFIXES, ".npy", ".png")


def load_map(
    path: PathLike, *, resolution: float | None = None, unknown_is_occupied: bool = True
) -> OccupancyGrid:
    """Load a map; the suffix says the format.

    - .yaml, .yml: ROS map_server file with its picture, see `load_ros_map`.
    - .map: MovingAI benchmark, see `load_movingai_map`.
    - .npy: (H, W) NumPy array of bool or of 0 and 1, row 0 at the lowest y, 1 is occupied.
    - .png, .pgm, .jpg, ...: plain picture, dark is occupied, see `load_image_map`. For a picture
      that belongs to a YAML file, load the YAML file.

    Args:
        path: The file.
        resolution: Side of a cell in metres for formats that do not store it; 0.05 by default.
        unknown_is_occupied: Whether cells never observed are obstacles.

    Returns:
        The map; its origin is (0, 0) where the format has none.

    Raises:
        InvalidMap: The file is missing, damaged or of an unknown format; the message names it.
        InvalidParameter: A resolution is given for a file that has its own.
    """
    file = Path(path)
    suffix = file.suffix.lower()
    if suffix in YAML_SUFFIXES:
        if resolution is not None:
            raise InvalidParameter(f"{file} states its own resolution; got resolution={resolution}")
        return load_ros_map(file, unknown_is_occupied=unknown_is_occupied)
    resolution = DEFAULT_RESOLUTION if resolution is None else resolution
    if suffix == ".map":
        return load_movingai_map(file, resolution=resolution)
    if suffix == ".npy":
        return _load_array(file, resolution)
    if suffix in IMAGE_SUFFIXES:
        return load_image_map(file, resolution=resolution, unknown_is_occupied=unknown_is_occupied)
    raise InvalidMap(f"{file}: unknown map format {suffix!r}; known: {', '.join(LOAD_SUFFIXES)}")


def save_map(grid: OccupancyGrid, path: PathLike) -> None:
    """Save a map; the suffix says the format. Files appear whole or not at all.

    - .yaml, .yml: ROS map_server file with a PGM picture beside it; keeps everything
      (`save_ros_map` says how to load unknown cells again).
    - .npy, .png: the occupied cells alone, without resolution, origin and unknown cells.

    Args:
        grid: The map.
        path: The file to write.

    Raises:
        InvalidParameter: The suffix is unknown or a file cannot be written.
    """
    file = Path(path)
    suffix = file.suffix.lower()
    if suffix in YAML_SUFFIXES:
        save_ros_map(grid, file)
    elif suffix == ".npy":
        buffer = io.BytesIO()
        np.save(buffer, grid.occupied)
        write_files({file: buffer.getvalue()})
    elif suffix == ".png":
        write_files({file: encode_png(grid)})
    else:
        raise InvalidParameter(
            f"{file}: a map cannot be saved as {suffix!r}; known: {', '.join(SAVE_SUFFIXES)}"
        )


_DAMAGED = (
    *(OSError, ValueError, EOFError, SyntaxError, tokenize.TokenError, zipfile.BadZipFile),
    *(MemoryError, OverflowError),  # a header that claims too much
)


def _load_array(file: Path, resolution: float) -> OccupancyGrid:
    with naming(file):
        data = read_bytes(file)
        try:
            array = np.load(io.BytesIO(data), allow_pickle=False)
        except _DAMAGED as error:
            raise InvalidMap(f"not a NumPy array file: {error}") from error
        return OccupancyGrid(array, resolution)
