from __future__ import annotations

import json

import pytest

from planformer.data.spec import MANIFEST, DatasetSpec, read_spec, write_spec
from planformer.errors import InvalidDataset, InvalidParameter

GOOD = {"kinds": ("maze", "forest"), "maps": 120, "paths_per_map": 5, "seed": 3}


def test_what_is_written_is_read(tmp_path):
    spec = DatasetSpec(**GOOD, robot_radius=0.25)
    write_spec(tmp_path, spec)
    assert read_spec(tmp_path) == spec
    assert [file.name for file in tmp_path.iterdir()] == [MANIFEST]


def test_shards_cover_every_map_once():
    shards = DatasetSpec(**GOOD).shards()
    assert list(shards) == [f"{k}-{n:05d}.npz" for k in ("forest", "maze") for n in range(3)]
    for kind in ("forest", "maze"):
        covered = [i for name, (k, indices) in shards.items() if k == kind for i in indices]
        assert covered == list(range(120))


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("kinds", ()),
        ("kinds", ("forest", "swamp")),
        ("maps", 0),
        ("maps", 1.5),
        ("paths_per_map", 0),
        ("seed", -1),
        ("size", 0.0),
        ("resolution", float("nan")),
        ("robot_radius", -0.1),
        ("min_distance", float("inf")),
        ("maps_per_shard", 0),
    ],
)
def test_a_value_out_of_range_is_an_error_that_names_it(name, value):
    with pytest.raises(InvalidParameter, match=name):
        DatasetSpec(**{**GOOD, name: value})


def change(**values):
    return lambda manifest: json.dumps({**manifest, **values})


@pytest.mark.parametrize(
    ("edit", "message"),
    [
        (lambda manifest: "{", "damaged"),
        (lambda manifest: "[]", "damaged"),
        (lambda manifest: "{}", "damaged"),
        (change(format=99), "format 99"),
        (change(colour="red"), "colour"),
        (change(maps=None), "damaged"),
        (change(size=None), "damaged"),
        (change(kinds=7), "damaged"),
        (change(kinds=["swamp"]), "swamp"),
    ],
)
def test_a_damaged_manifest_is_an_error(tmp_path, edit, message):
    write_spec(tmp_path, DatasetSpec(**GOOD))
    file = tmp_path / MANIFEST
    file.write_text(edit(json.loads(file.read_text())))
    with pytest.raises(InvalidDataset, match=message):
        read_spec(tmp_path)


def test_a_folder_without_manifest_is_an_error(tmp_path):
    with pytest.raises(InvalidDataset, match="not a data set"):
        read_spec(tmp_path)
    with pytest.raises(InvalidDataset, match="not a data set"):
        read_spec(tmp_path / "none")
