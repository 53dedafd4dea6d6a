"""Users' own maps: every map file in a folder, read and tried before any work begins."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from planformer.data.problems import random_problems
from planformer.data.recipe import StoredMap
from planformer.errors import InvalidMap, InvalidParameter
from planformer.maps.folder import map_files
from planformer.maps.io import LOAD_SUFFIXES, YAML_SUFFIXES, load_map
from planformer.robots import PointRobot


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
    files = map_files(folder)
    if not files:
        raise InvalidParameter(
            f"{folder} holds no map; files that count: {', '.join(LOAD_SUFFIXES)}"
        )
    maps = []
    for file in files:
        stated = file.suffix.lower() in YAML_SUFFIXES
        grid = load_map(file, resolution=None if stated else resolution)
        try:
            next(
                random_problems(
                    grid,
                    PointRobot(robot_radius),
                    min_distance=min_distance,
                    max_distance=max_distance,
                    rng=np.random.default_rng(0),
                )
            )
        except InvalidParameter as error:
            raise InvalidMap(f"{file} cannot be used: {error}") from error
        maps.append(StoredMap.of(file.relative_to(folder).as_posix(), grid))
    return maps
