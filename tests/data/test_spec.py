from __future__ import annotations

import json

import pytest

from planformer.data.spec import MANIFEST, DatasetSpec, differences, read_spec, write_spec
from planformer.errors import InvalidDataset, InvalidParameter, InvalidRobot
from planformer.robots import DubinsCar, PointRobot

GOOD = {"kinds": ("maze", "forest"), "maps": 120, "paths_per_map": 5, "seed": 3}


CAR = {"robot": "dubins", "robot_radius": 0.2, "turning_radius": 0.55, "max_distance": 15.0}


@pytest.mark.parametrize("extra", [{}, CAR, {"user_maps": (("a.png", 7), ("b/c.yaml", 8))}])
def test_what_is_written_is_read(tmp_path, extra):
    spec = DatasetSpec(**GOOD, **extra)
    write_spec(tmp_path, spec)
    assert read_spec(tmp_path) == spec
    assert [file.name for file in tmp_path.iterdir()] == [MANIFEST]


def test_shards_cover_every_map_once():
    shards = DatasetSpec(**GOOD).shards()
    assert list(shards) == [f"{k}-{n:05d}.parquet" for k in ("forest", "maze") for n in range(5)]
    for kind in ("forest", "maze"):
        covered = [i for name, (k, indices) in shards.items() if k == kind for i in indices]
        assert covered == list(range(120))


def test_maps_of_ones_own_have_shards_too():
    own = tuple((f"{i}.png", i) for i in range(30))
    alone = DatasetSpec(kinds=(), maps=0, paths_per_map=1, seed=0, user_maps=own)
    both = DatasetSpec(**GOOD, user_maps=own)
    assert alone.shards() == {
        "user-00000.parquet": ("user", range(25)),
        "user-00001.parquet": ("user", range(25, 30)),
    }
    assert both.shards().items() >= alone.shards().items()
    assert (alone.total_maps, both.total_maps) == (30, 270)


def test_the_robot_is_made_from_the_settings():
    assert DatasetSpec(**GOOD).make_robot() == PointRobot(0.1)
    assert DatasetSpec(**GOOD, **CAR).make_robot() == DubinsCar(0.2, 0.55)


def test_differences_name_the_settings():
    first, second = DatasetSpec(**GOOD), DatasetSpec(**{**GOOD, "seed": 4}, min_distance=2.0)
    assert differences(first, second) == "seed 3, not 4; min_distance 3.0, not 2.0"


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("kinds", ()),
        ("kinds", ("forest", "swamp")),
        ("maps", 0),
        ("maps", 1.5),
        ("paths_per_map", 0),
        ("seed", -1),
        ("width", 0.0),
        ("height", float("inf")),
        ("resolution", float("nan")),
        ("robot_radius", -0.1),
        ("min_distance", float("inf")),
        ("max_distance", 3.0),
        ("robot", "tank"),
        ("turning_radius", 0.5),
        ("expert", None),
        ("expert_seconds", 0.0),
        ("expert_vertices", 1.5),
        ("maps_per_shard", 0),
    ],
)
def test_a_value_out_of_range_is_an_error_that_names_it(name, value):
    with pytest.raises((InvalidParameter, InvalidRobot), match=name.removeprefix("robot_")):
        DatasetSpec(**{**GOOD, name: value})


def test_settings_that_contradict_are_an_error():
    with pytest.raises(InvalidParameter, match="turning_radius"):
        DatasetSpec(**GOOD, robot="dubins")
    with pytest.raises(InvalidParameter, match="0 without kinds"):
        DatasetSpec(**{**GOOD, "kinds": ()}, user_maps=(("a.png", 1),))


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
        (change(width=None), "damaged"),
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
