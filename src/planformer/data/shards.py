"""Shards: the files that hold a data set's maps and paths. The file format is known here alone.

A shard is an Apache Parquet file (zstd, with a CRC of every page) of one row a map, all of one
kind. Its columns, null only where it says so:

    kind        string     the generator's name, or "user" for a map of the user's own
    seed        uint64     the generator's seed; null for a user's map
    name        string     file of a user's map in its folder; null for a generated one
    width       double     extent along x in metres
    height      double     extent along y in metres
    resolution  double     side of a cell in metres
    checksum    uint32     CRC-32 of the occupied cells, packed as in `cells`
    cells       binary     a user's map: numpy.packbits of the occupied cells, row after row from
                           the lowest y; null for a generated one
    unsolved    uint32     problems drawn on the map that the expert found no path for
    paths       list<list<struct<x: double, y: double>>>, for a car struct<x, y, yaw>

A path is its vertices in metres, in the frame of the map's lower-left corner; a car's are the
poses (yaw in rad) between its arcs and straight lines. A problem's start and goal are the first
and the last vertex of its path. Doubles keep paths exactly as they were checked and cost no more
than floats would: vertices at the centres of cells repeat, and Parquet stores each value once.

The schema's metadata hold ``planformer.format`` (see `planformer.data.spec.FORMAT`) and
``planformer.robot``, JSON of [name, radius, turning radius or null].
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from planformer.data.recipe import USER_KIND, AnyMap, MapRecipe, StoredMap
from planformer.data.robot import make_robot, robot_settings
from planformer.data.spec import FORMAT
from planformer.errors import InvalidDataset, MissingExtra
from planformer.files import whole_file
from planformer.robots import Robot

try:
    import pyarrow as pa
    import pyarrow.parquet as pq
except ImportError as error:
    raise MissingExtra("pyarrow", "train") from error

_FORMAT_KEY, _ROBOT_KEY = b"planformer.format", b"planformer.robot"
_AXES = ("x", "y", "yaw")


class MapPaths(NamedTuple):
    """A map and the paths on it.

    Attributes:
        recipe: The map.
        checksum: Of the map's cells, see `planformer.data.recipe.checksum`.
        paths: Paths of shape (N, 2) or (N, 3), N >= 2, in metres and rad, local frame.
        unsolved: Number of problems drawn that the expert found no path for.
    """

    recipe: AnyMap
    checksum: int
    paths: Sequence[NDArray[np.float64]]
    unsolved: int = 0


@dataclass(frozen=True, eq=False)
class Shard:
    """Maps and the paths on them.

    Attributes:
        robot: The robot that the paths are for.
        recipes: The M maps, at least one; all of one kind.
        checksums: (M,) uint32, of the cells of each map.
        unsolved: (M,) uint32, problems on each map that the expert found no path for.
        map_index: (P,) int64, the map of each path, ascending.
        offsets: (P + 1,) int64, path i is `vertices[offsets[i]:offsets[i + 1]]`.
        vertices: (V, D) float64, the vertices of all paths in metres and rad, local frame; D is
            the robot's `state_dimension`.

    Raises:
        InvalidDataset: The arrays do not fit together.
    """

    robot: Robot
    recipes: tuple[AnyMap, ...]
    checksums: NDArray[np.uint32]
    unsolved: NDArray[np.uint32]
    map_index: NDArray[np.int64]
    offsets: NDArray[np.int64]
    vertices: NDArray[np.float64]

    def __post_init__(self) -> None:
        paths, maps, vertices = len(self.map_index), len(self.recipes), len(self.vertices)
        dimension = self.robot.state_dimension
        for rule, holds in (
            ("a map", maps > 0),
            ("maps of one kind", len({recipe.kind for recipe in self.recipes}) == 1),
            ("a checksum a map", self.checksums.shape == (maps,)),
            ("a number of unsolved problems a map", self.unsolved.shape == (maps,)),
            (f"vertices of shape (V, {dimension})", self.vertices.shape == (vertices, dimension)),
            ("finite vertices", np.isfinite(self.vertices).all()),
            ("map indices of shape (P,)", self.map_index.shape == (paths,)),
            ("map indices inside the shard", _all_in(self.map_index, 0, maps - 1)),
            ("ascending map indices", _all_in(np.diff(self.map_index), 0, maps)),
            ("an offset more than paths", self.offsets.shape == (paths + 1,)),
            ("offsets from 0 to V", _ends(self.offsets) == [0, vertices]),
            ("two vertices or more a path", _all_in(np.diff(self.offsets), 2, vertices)),
        ):
            if not holds:
                raise InvalidDataset(f"a shard needs {rule}")

    @classmethod
    def from_maps(cls, maps: Sequence[MapPaths], robot: Robot) -> Shard:
        """Pack maps and their paths."""
        paths = [path for of_map in maps for path in of_map.paths]
        return cls(
            robot=robot,
            recipes=tuple(of_map.recipe for of_map in maps),
            checksums=np.array([of_map.checksum for of_map in maps], np.uint32),
            unsolved=np.array([of_map.unsolved for of_map in maps], np.uint32),
            map_index=np.repeat(np.arange(len(maps)), [len(of_map.paths) for of_map in maps]),
            offsets=np.cumsum([0, *map(len, paths)], dtype=np.int64),
            vertices=np.concatenate(paths),
        )


def shard_schema(robot: Robot) -> Any:
    """The Arrow schema of the shards for a robot (a `pyarrow.Schema`)."""
    axes = [pa.field(axis, pa.float64(), nullable=False) for axis in _AXES]
    vertex = pa.field("element", pa.struct(axes[: robot.state_dimension]), nullable=False)
    path = pa.field("element", pa.list_(vertex), nullable=False)
    columns = [
        ("kind", pa.string(), False),
        ("seed", pa.uint64(), True),
        ("name", pa.string(), True),
        ("width", pa.float64(), False),
        ("height", pa.float64(), False),
        ("resolution", pa.float64(), False),
        ("checksum", pa.uint32(), False),
        ("cells", pa.binary(), True),
        ("unsolved", pa.uint32(), False),
        ("paths", pa.list_(path), False),
    ]
    metadata = {_FORMAT_KEY: str(FORMAT), _ROBOT_KEY: json.dumps(robot_settings(robot))}
    return pa.schema([pa.field(n, kind, nullable=null) for n, kind, null in columns], metadata)


def write_shard(path: Path, shard: Shard) -> None:
    """Write a shard; the file appears whole or not at all.

    Raises:
        OSError: The file cannot be written.
    """
    schema = shard_schema(shard.robot)
    columns = {
        **_map_columns(shard.recipes),
        "checksum": shard.checksums,
        "unsolved": shard.unsolved,
        "paths": _nested(shard, schema.field("paths").type),
    }
    table = pa.table([pa.array(columns[f.name], f.type) for f in schema], schema=schema)
    buffer = pa.BufferOutputStream()
    pq.write_table(
        table, buffer, compression="zstd", write_statistics=False, write_page_checksum=True
    )
    with whole_file(path) as file:
        file.write(buffer.getvalue())


def read_shard(path: Path) -> Shard:
    """Read and check a shard.

    Raises:
        InvalidDataset: The file is missing, damaged, of another version or not a shard.
    """
    try:
        return _parsed(path.read_bytes())
    except FileNotFoundError:
        raise InvalidDataset(f"the shard {path} is missing") from None
    except _OtherVersion as error:
        raise InvalidDataset(f"the shard {path} {error}") from None
    except Exception as error:  # damage surfaces as almost anything in Arrow and NumPy
        raise InvalidDataset(f"the shard {path} is damaged: {error}") from error


class _OtherVersion(Exception):
    """A whole Parquet file that this version does not read."""


def _parsed(data: bytes) -> Shard:
    file = pq.ParquetFile(pa.BufferReader(data), page_checksum_verification=True)
    robot = _robot(file.schema_arrow.metadata or {})
    expected = shard_schema(robot)
    if not file.schema_arrow.equals(expected):
        raise _OtherVersion(f"has another schema than {expected.to_string(show_field_metadata=0)}")
    table = file.read(use_threads=False).combine_chunks()
    table.validate(full=True)
    of_maps = table.column("paths").combine_chunks()
    paths = of_maps.flatten()
    vertices = paths.flatten()
    counts = np.diff(of_maps.offsets.to_numpy())
    return Shard(
        robot=robot,
        recipes=tuple(map(_recipe, table.drop_columns(["paths"]).to_pylist())),
        checksums=table.column("checksum").to_numpy(),
        unsolved=table.column("unsolved").to_numpy(),
        map_index=np.repeat(np.arange(table.num_rows), counts),
        offsets=paths.offsets.to_numpy().astype(np.int64),
        vertices=np.stack(
            [vertices.field(axis).to_numpy() for axis in _AXES[: robot.state_dimension]], axis=1
        ),
    )


def _robot(metadata: Mapping[bytes, bytes]) -> Robot:
    version = metadata.get(_FORMAT_KEY, b"none").decode()
    if version != str(FORMAT):
        raise _OtherVersion(f"has format {version}; this version reads {FORMAT}")
    name, radius, turning_radius = json.loads(metadata[_ROBOT_KEY])
    return make_robot(name, radius, turning_radius)


def _map_columns(recipes: Sequence[AnyMap]) -> dict[str, list[Any]]:
    """What tells the maps apart; None where a map has no such attribute."""
    attributes = {n: n for n in ("kind", "seed", "name", "width", "height", "resolution")}
    return {
        column: [getattr(recipe, attribute, None) for recipe in recipes]
        for column, attribute in {**attributes, "cells": "packed"}.items()
    }


def _recipe(row: Mapping[str, Any]) -> AnyMap:
    width, height, resolution = row["width"], row["height"], row["resolution"]
    if row["kind"] != USER_KIND:
        return MapRecipe(row["kind"], row["seed"], width, height, resolution)
    shape = round(height / resolution), round(width / resolution)
    return StoredMap(row["name"], shape, resolution, row["cells"])


def _nested(shard: Shard, kind: Any) -> Any:
    """The paths of each map as an Arrow array."""
    of_paths = kind.value_type
    axes = [pa.array(axis) for axis in shard.vertices.T]
    vertices = pa.StructArray.from_arrays(axes, fields=list(of_paths.value_type))
    paths = pa.ListArray.from_arrays(pa.array(shard.offsets, pa.int32()), vertices, of_paths)
    firsts = np.searchsorted(shard.map_index, np.arange(len(shard.recipes) + 1))
    return pa.ListArray.from_arrays(pa.array(firsts, pa.int32()), paths, kind)


def _all_in(values: NDArray[np.int64], low: int, high: int) -> bool:
    return bool(np.all((values >= low) & (values <= high)))


def _ends(offsets: NDArray[np.int64]) -> list[int]:
    return [*offsets[:1].tolist(), *offsets[-1:].tolist()]
