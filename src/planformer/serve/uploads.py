"""Uploaded files as maps. They come from anyone: nothing is decoded before its size is known."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import PurePosixPath, PureWindowsPath

from planformer.errors import InvalidMap, InvalidParameter
from planformer.maps import OccupancyGrid
from planformer.maps.image import Picture, decode_picture, image_map
from planformer.maps.io import DEFAULT_RESOLUTION, YAML_SUFFIXES
from planformer.maps.movingai import parse_movingai_map
from planformer.maps.ros import parse_ros_map
from planformer.serve.served_map import ServedMap

_FORMATS = ("BMP", "JPEG", "PNG", "PPM")  # PPM is PGM too
_SUFFIXES = (".bmp", ".jpeg", ".jpg", ".pbm", ".pgm", ".png", ".ppm")
_DESCRIPTION_BYTES = 2**16
_LONGEST_NAME = 80
_SCAN, _MOST_SCANS = b"\xff\xda", 100
"""Each scan of a progressive JPEG goes over the whole picture: many in a small file take hours."""


def read_upload(
    files: Mapping[str, bytes], *, resolution: float | None, map_cells: int
) -> ServedMap:
    """The map in uploaded files.

    Args:
        files: Content of each file by its name: a picture, a MovingAI .map, or a ROS map's YAML
            file with its picture.
        resolution: Side of a cell in metres for formats that do not store it.
        map_cells: Most cells of a map.

    Raises:
        InvalidMap: The files are damaged or no map.
        TooLarge: The picture has too many pixels.
        InvalidParameter: A resolution is given for a map that has its own.
    """
    contents = {base_name(name): data for name, data in files.items()}
    if len(contents) < len(files):
        raise InvalidMap("two files have the same name")
    described = [name for name in contents if _suffix(name) in YAML_SUFFIXES]
    if len(contents) == 2 and len(described) == 1:
        if resolution is not None:
            raise InvalidParameter("a ROS map states its own resolution; leave it out")
        name = described[0]
    elif len(contents) == 1 and not described:
        (name,) = contents
    else:
        raise InvalidMap(
            "a map is one picture, one MovingAI .map file, or a ROS map's .yaml file together with "
            f"its picture; got {', '.join(contents)[:_LONGEST_NAME] or 'no file'}"
        )
    try:
        if described:
            return ServedMap(_title(name), _ros_map(name, contents, map_cells))
        resolution = DEFAULT_RESOLUTION if resolution is None else resolution
        return ServedMap(_title(name), _single(name, contents[name], resolution, map_cells))
    except InvalidMap as error:
        raise InvalidMap(f"{name[-_LONGEST_NAME:]}: {error}") from error


def base_name(name: str) -> str:
    """The last part of a file name as a browser sends it, whatever the system."""
    return PureWindowsPath(PurePosixPath(name).name).name


def _suffix(name: str) -> str:
    return PurePosixPath(name).suffix.lower()


def _title(name: str) -> str:
    """A printable name without the suffix."""
    title = "".join(c for c in PurePosixPath(name).stem if c.isprintable())
    return title[:_LONGEST_NAME] or "map"


def _single(name: str, data: bytes, resolution: float, map_cells: int) -> OccupancyGrid:
    if _suffix(name) == ".map":
        return parse_movingai_map(data, resolution)
    return image_map(_picture(name, data, map_cells), resolution)


def _ros_map(name: str, contents: Mapping[str, bytes], map_cells: int) -> OccupancyGrid:
    def picture_of(image: str) -> Picture:
        # The path is that of the uploader's disk; only its last part can name an upload.
        picture = base_name(image)
        if picture not in contents or picture == name:
            raise InvalidMap(f"it names the picture {picture[:_LONGEST_NAME]!r}: upload that too")
        return _picture(picture, contents[picture], map_cells)

    if len(contents[name]) > _DESCRIPTION_BYTES:
        raise InvalidMap(f"a map's YAML file has at most {_DESCRIPTION_BYTES} bytes")
    return parse_ros_map(contents[name], picture_of)


def _picture(name: str, data: bytes, map_cells: int) -> Picture:
    if _suffix(name) not in _SUFFIXES:
        raise InvalidMap(
            f"unknown map format {_suffix(name)!r}; known: .yaml with its picture, .map, "
            f"{', '.join(_SUFFIXES)}"
        )
    if data.startswith(b"\xff\xd8") and data.count(_SCAN) > _MOST_SCANS:
        raise InvalidMap(f"a JPEG has at most {_MOST_SCANS} scans here")
    return decode_picture(data, formats=_FORMATS, most_pixels=map_cells)
