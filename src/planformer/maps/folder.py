"""The map files in a folder."""

from __future__ import annotations

from pathlib import Path

from planformer.errors import InvalidMap
from planformer.maps._files import read_bytes
from planformer.maps.image import IMAGE_SUFFIXES
from planformer.maps.io import LOAD_SUFFIXES, YAML_SUFFIXES
from planformer.maps.ros import read_description


def map_files(folder: Path) -> list[Path]:
    """The map files in a folder and its subfolders, sorted; none where it does not exist.

    Hidden files are left out, and pictures that belong to a ROS map's YAML file.
    """
    found = sorted(
        file
        for file in folder.rglob("*")
        if file.suffix.lower() in LOAD_SUFFIXES
        and file.is_file()
        and not any(part.startswith(".") for part in file.relative_to(folder).parts)
    )
    pictures = {picture_of(file) for file in found if file.suffix.lower() in YAML_SUFFIXES}
    return [
        file
        for file in found
        if file.suffix.lower() not in IMAGE_SUFFIXES or file.resolve() not in pictures
    ]


def description_of(picture: Path) -> Path | None:
    """The YAML file beside a picture that makes it a ROS map; None where there is none."""
    beside = (picture.with_suffix(suffix) for suffix in YAML_SUFFIXES)
    return next((file for file in beside if picture_of(file) == picture.resolve()), None)


def picture_of(file: Path) -> Path | None:
    """The picture that a ROS map's YAML file names; what is wrong with the file shows later."""
    try:
        named = read_description(read_bytes(file))["image"]
        return Path(file.parent, named).resolve()
    except (InvalidMap, OSError, ValueError, TypeError, KeyError):
        return None
