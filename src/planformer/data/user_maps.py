"""Users' own maps: every map file in a folder, read and tried before any work begins."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import yaml

from planformer.data.problems import draw_problems
from planformer.data.recipe import StoredMap
from planformer.errors import InvalidMap, InvalidParameter
from planformer.maps.image import IMAGE_SUFFIXES
from planformer.maps.io import LOAD_SUFFIXES, YAML_SUFFIXES, load_map


def map_files(folder: Path) -> list[Path]:
    """The map files in a folder and its subfolders, sorted.

    Hidden files are left out, and pictures that belong to a ROS map's YAML file.

    Raises:
        InvalidParameter: The folder does not exist or holds no map.
    """
    found = sorted(
        file
        for file in folder.rglob("*")
        if file.suffix.lower() in LOAD_SUFFIXES
        and file.is_file()
        and not any(part.startswith(".") for part in file.relative_to(folder).parts)
    )
    pictures = {_picture_of(file) for file in found if file.suffix.lower() in YAML_SUFFIXES}
    maps = [
        file
        for file in found
        if file.suffix.lower() not in IMAGE_SUFFIXES or file.resolve() not in pictures
    ]
    if not maps:
        raise InvalidParameter(
            f"{folder} holds no map; files that count: {', '.join(LOAD_SUFFIXES)}"
        )
    return maps


def read_user_maps(
    folder: Path,
    *,
    resolution: float,
    robot_radius: float,
    min_distance: float,
    max_distance: float | None,
) -> list[StoredMap]:
    """Read every map in a folder and check that problems can be drawn on it.

    Args:
        folder: The folder.
        resolution: Side of a cell in metres, for files that do not state it.
        robot_radius: Radius of the robot in metres.
        min_distance: Least straight-line distance from start to goal in metres.
        max_distance: Greatest straight-line distance in metres; None = any.

    Returns:
        The maps in the order of their names. Unknown cells are occupied.

    Raises:
        InvalidMap: A file cannot be read, or has no room for the robot's problems.
        InvalidParameter: The folder does not exist or holds no map.
    """
    maps = []
    for file in map_files(folder):
        stated = file.suffix.lower() in YAML_SUFFIXES
        grid = load_map(file, resolution=None if stated else resolution)
        try:
            draw_problems(
                grid,
                robot_radius,
                1,
                min_distance=min_distance,
                max_distance=max_distance,
                rng=np.random.default_rng(0),
            )
        except InvalidParameter as error:
            raise InvalidMap(f"{file} cannot be used: {error}") from error
        maps.append(StoredMap.of(file.relative_to(folder).as_posix(), grid))
    return maps


def _picture_of(file: Path) -> Path | None:
    """The picture that a ROS map's YAML file names; what is wrong with the file shows later."""
    try:
        named = yaml.safe_load(file.read_text(encoding="utf-8"))["image"]
        return Path(file.parent, named).resolve()
    except (OSError, ValueError, TypeError, KeyError, yaml.YAMLError):
        return None
