from __future__ import annotations

import dataclasses
import io

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from planformer.data import shards
from planformer.data.recipe import MapRecipe, StoredMap
from planformer.data.shards import MapPaths, Shard, read_shard, shard_schema, write_shard
from planformer.errors import InvalidDataset
from planformer.maps import OccupancyGrid
from planformer.robots import DubinsCar, PointRobot

ROBOT = PointRobot(0.1)


def make_shard(robot=ROBOT):
    rng = np.random.default_rng(0)
    maps = [
        MapPaths(
            MapRecipe("forest", 2**63 + seed, 24.0, 12.0, 0.05),
            checksum=seed,
            paths=[rng.random((int(n), robot.state_dimension)) for n in rng.integers(2, 9, 3)],
            unsolved=10 + seed,
        )
        for seed in range(4)
    ]
    return maps, Shard.from_maps(maps, robot)


@pytest.fixture
def shard_file(tmp_path):
    write_shard(tmp_path / "shard.parquet", make_shard()[1])
    return tmp_path / "shard.parquet"


@pytest.mark.parametrize("robot", [ROBOT, DubinsCar(0.2, 0.549)])
def test_what_is_written_is_read(tmp_path, robot):
    maps, written = make_shard(robot)
    write_shard(tmp_path / "shard.parquet", written)
    shard = read_shard(tmp_path / "shard.parquet")
    assert shard.robot == robot
    assert shard.recipes == tuple(of_map.recipe for of_map in maps)
    assert shard.checksums.tolist() == [0, 1, 2, 3]
    assert shard.unsolved.tolist() == [10, 11, 12, 13]
    assert shard.map_index.tolist() == np.repeat(range(4), 3).tolist()
    paths = [path for of_map in maps for path in of_map.paths]
    for path, first, last in zip(paths, shard.offsets, shard.offsets[1:], strict=False):
        np.testing.assert_array_equal(shard.vertices[first:last], path)


def test_maps_of_users_are_stored_with_their_cells(tmp_path):
    rng = np.random.default_rng(1)
    grids = [OccupancyGrid(rng.random(shape) < 0.3, 0.1) for shape in ((5, 7), (8, 16), (3, 3))]
    maps = [
        MapPaths(StoredMap.of(f"{i}.yaml", grid), i, [np.zeros((2, 2))])
        for i, grid in enumerate(grids)
    ]
    write_shard(tmp_path / "shard.parquet", Shard.from_maps(maps, ROBOT))
    recipes = read_shard(tmp_path / "shard.parquet").recipes
    assert [recipe.name for recipe in recipes] == ["0.yaml", "1.yaml", "2.yaml"]
    assert [recipe.shape for recipe in recipes] == [(5, 7), (8, 16), (3, 3)]
    assert [recipe.grid() for recipe in recipes] == grids


def test_other_tools_read_the_columns(shard_file):
    rows = pq.read_table(shard_file).to_pylist()
    maps, _ = make_shard()
    first = maps[0].paths[0]
    assert rows[0]["paths"][0] == [{"x": x, "y": y} for x, y in first.tolist()]
    assert (rows[2]["kind"], rows[2]["seed"], rows[2]["cells"]) == ("forest", 2**63 + 2, None)


def test_paths_between_cells_cost_about_a_byte_and_a_half_a_coordinate(tmp_path):
    rng = np.random.default_rng(0)
    paths = [(rng.integers(480, size=(30, 2)) + 0.5) * 0.05 for _ in range(500)]
    maps = [MapPaths(MapRecipe("maze", 0, 24.0, 24.0, 0.05), 0, paths)]
    write_shard(tmp_path / "shard.parquet", Shard.from_maps(maps, ROBOT))
    assert (tmp_path / "shard.parquet").stat().st_size < 500 * 30 * 2 * 1.5


def test_an_interrupt_leaves_no_file(tmp_path, monkeypatch):
    def interrupted(descriptor):
        raise KeyboardInterrupt

    monkeypatch.setattr("os.fsync", interrupted)
    with pytest.raises(KeyboardInterrupt):
        write_shard(tmp_path / "shard.parquet", make_shard()[1])
    assert list(tmp_path.iterdir()) == []


@settings(max_examples=300, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.data())
def test_damage_is_noticed_or_harmless(shard_file, data):
    content = bytearray(shard_file.read_bytes())
    position = data.draw(st.integers(0, len(content) - 1))
    if data.draw(st.booleans()):
        content = content[:position]
    else:
        content[position] ^= data.draw(st.integers(1, 255))
    damaged = shard_file.with_name("damaged.parquet")
    damaged.write_bytes(content)
    try:
        shard = read_shard(damaged)
    except InvalidDataset:
        return
    # Bytes that nothing depends on, as the name of the program that wrote the file.
    expected = make_shard()[1]
    np.testing.assert_array_equal(shard.vertices, expected.vertices)
    np.testing.assert_array_equal(shard.checksums, expected.checksums)


@pytest.mark.parametrize(
    ("change", "rule"),
    [
        ({"recipes": ()}, "a map"),
        ({"checksums": np.zeros(3, np.uint32)}, "checksum"),
        ({"unsolved": np.zeros(3, np.uint32)}, "unsolved"),
        ({"map_index": np.full(12, 4)}, "map indices inside"),
        ({"map_index": np.arange(12)[::-1] // 3}, "ascending"),
        ({"map_index": np.zeros((12, 2), int)}, "map indices of shape"),
        ({"offsets": np.arange(0, 26, 2)}, "offsets from 0 to V"),
        ({"offsets": np.empty(0, int)}, "an offset more than paths"),
        ({"offsets": np.arange(5)}, "an offset more than paths"),
        ({"vertices": np.zeros((60, 3))}, "shape"),
        ({"vertices": np.full((60, 2), np.nan)}, "finite"),
    ],
)
def test_arrays_that_do_not_fit_are_an_error(change, rule):
    with pytest.raises(InvalidDataset, match=rule):
        dataclasses.replace(make_shard()[1], **change)


def test_a_missing_file_or_another_file_is_an_error(tmp_path):
    with pytest.raises(InvalidDataset, match="missing"):
        read_shard(tmp_path / "none.parquet")
    np.savez(tmp_path / "array.parquet", np.zeros(3))
    with pytest.raises(InvalidDataset, match="damaged"):
        read_shard(tmp_path / "array.parquet.npz")
    pq.write_table(pa.table({"x": [1.0]}), tmp_path / "other.parquet")
    with pytest.raises(InvalidDataset, match=r"other\.parquet has format none"):
        read_shard(tmp_path / "other.parquet")


def test_another_version_or_schema_is_an_error(tmp_path, monkeypatch):
    with monkeypatch.context() as patch:
        patch.setattr(shards, "FORMAT", 99)
        write_shard(tmp_path / "new.parquet", make_shard()[1])
    with pytest.raises(InvalidDataset, match=r"new\.parquet has format 99; this version reads"):
        read_shard(tmp_path / "new.parquet")
    metadata = shard_schema(ROBOT).metadata
    buffer = io.BytesIO()
    pq.write_table(pa.table({"x": [1.0]}).replace_schema_metadata(metadata), buffer)
    (tmp_path / "other.parquet").write_bytes(buffer.getvalue())
    with pytest.raises(InvalidDataset, match="has another schema"):
        read_shard(tmp_path / "other.parquet")
