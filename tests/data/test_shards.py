from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from planformer.data.recipe import MapRecipe
from planformer.data.shards import MapPaths, Shard, read_shard, write_shard
from planformer.errors import InvalidDataset


def make_shard():
    rng = np.random.default_rng(0)
    maps = [
        MapPaths(
            MapRecipe("forest", 2**63 + seed, 24.0, 12.0, 0.05),
            checksum=seed,
            paths=[rng.random((int(n), 2)) for n in rng.integers(2, 9, 3)],
        )
        for seed in range(4)
    ]
    return maps, Shard.from_maps(maps, 0.1)


@pytest.fixture
def shard_file(tmp_path):
    write_shard(tmp_path / "shard.npz", make_shard()[1])
    return tmp_path / "shard.npz"


def test_what_is_written_is_read(shard_file):
    maps, _ = make_shard()
    shard = read_shard(shard_file)
    assert shard.recipes == tuple(of_map.recipe for of_map in maps)
    assert shard.checksums.tolist() == [0, 1, 2, 3]
    assert shard.robot_radius == 0.1
    assert shard.map_index.tolist() == np.repeat(range(4), 3).tolist()
    paths = [path for of_map in maps for path in of_map.paths]
    for path, first, last in zip(paths, shard.offsets, shard.offsets[1:], strict=False):
        np.testing.assert_array_equal(shard.vertices[first:last], path)


def test_an_interrupt_leaves_no_file(tmp_path, monkeypatch):
    def interrupted(file, **_):
        file.write(b"half")
        raise KeyboardInterrupt

    monkeypatch.setattr(np, "savez", interrupted)
    with pytest.raises(KeyboardInterrupt):
        write_shard(tmp_path / "shard.npz", make_shard()[1])
    assert list(tmp_path.iterdir()) == []


@settings(
    max_examples=200, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(data=st.data())
def test_damage_is_noticed_or_harmless(shard_file, data):
    content = bytearray(shard_file.read_bytes())
    position = data.draw(st.integers(0, len(content) - 1))
    if data.draw(st.booleans()):
        content = content[:position]
    else:
        content[position] ^= data.draw(st.integers(1, 255))
    damaged = shard_file.with_name("damaged.npz")
    damaged.write_bytes(content)
    try:
        shard = read_shard(damaged)
    except InvalidDataset:
        return
    # Bytes that nothing depends on, as an archive's time stamps.
    np.testing.assert_array_equal(shard.vertices, make_shard()[1].vertices)


@pytest.mark.parametrize(
    ("change", "rule"),
    [
        ({"recipes": ()}, "a map"),
        ({"checksums": np.zeros(3, np.uint32)}, "checksum"),
        ({"map_index": np.full(12, 4)}, "map indices inside"),
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
        read_shard(tmp_path / "none.npz")
    np.save(tmp_path / "array.npy", np.zeros(3))
    with pytest.raises(InvalidDataset, match="damaged"):
        read_shard(tmp_path / "array.npy")
    np.savez(tmp_path / "other.npz", kind=np.array("forest"))
    with pytest.raises(InvalidDataset, match="damaged"):
        read_shard(tmp_path / "other.npz")
