from __future__ import annotations

import contextlib
import os
from pathlib import Path

import numpy as np
import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from PIL import Image

from planformer.errors import InvalidMap, InvalidParameter
from planformer.maps import OccupancyGrid
from planformer.maps.folder import map_files
from planformer.maps.ros import load_ros_map, save_ros_map

METADATA = {
    "image": "map.pgm",
    "mode": "trinary",
    "resolution": 0.05,
    "origin": [-1.0, 2.0, 0.5],
    "negate": 0,
    "occupied_thresh": 0.65,
    "free_thresh": 0.196,
}


def write_map(folder: Path, pixels, image_mode=None, **metadata) -> Path:
    content = {**METADATA, **metadata}
    content = {key: value for key, value in content.items() if value is not None}
    Image.fromarray(np.asarray(pixels), image_mode).save(folder / content["image"])
    file = folder / "map.yaml"
    file.write_text(yaml.safe_dump(content))
    return file


def values_of(file: Path) -> list[int]:
    """What the map says in the picture's order: -1, 0 or 100."""
    grid = load_ros_map(file)
    return grid.to_ros().reshape(grid.shape)[::-1].ravel().tolist()


GREYS = np.array([[0, 50, 89, 90, 127], [128, 200, 205, 206, 255]], np.uint8)


def test_trinary_thresholds_and_geometry(tmp_path):
    file = write_map(tmp_path, GREYS)
    assert values_of(file) == [100, 100, 100, -1, -1, -1, -1, -1, 0, 0]
    grid = load_ros_map(file)
    assert grid.shape == (2, 5)
    assert grid.resolution == 0.05
    assert grid.origin == (-1.0, 2.0, 0.5)
    assert grid.occupied[1].tolist() == [True] * 5  # the top of the picture has the highest y
    np.testing.assert_array_equal(grid.occupied, grid.to_ros().reshape(2, 5) != 0)


def test_unknown_can_be_free(tmp_path):
    grid = load_ros_map(write_map(tmp_path, GREYS), unknown_is_occupied=False)
    assert (grid.unknown & grid.occupied).sum() == 0
    assert grid.occupied.sum() == 3


def test_negate(tmp_path):
    file = write_map(tmp_path, GREYS, negate=1)
    assert values_of(file) == [0, -1, -1, -1, -1, -1, 100, 100, 100, 100]


@pytest.mark.parametrize("negate", [False, True, 0, 1])
def test_negate_may_be_a_bool(tmp_path, negate):
    file = write_map(tmp_path, [[np.uint8(0)]], negate=negate)
    assert values_of(file) == ([0] if negate else [100])


def test_a_threshold_itself_is_unknown(tmp_path):
    levels = np.array([[51, 204]], np.uint8)
    file = write_map(tmp_path, levels, occupied_thresh=0.8, free_thresh=0.2)
    assert values_of(file) == [-1, -1]


def test_files_without_a_mode_are_trinary(tmp_path):
    assert values_of(write_map(tmp_path, GREYS, mode=None)) == values_of(write_map(tmp_path, GREYS))


def test_scale_spreads_the_values_between_the_thresholds(tmp_path):
    # Darkness 0.90, 0.78, 0.5, 0.22, 0.10 between thresholds 0.2 and 0.8: 100, 97, 50, 3, 0.
    levels = np.array([[25, 56, 128, 199, 230]], np.uint8)
    file = write_map(tmp_path, levels, mode="scale", occupied_thresh=0.8, free_thresh=0.2)
    assert values_of(file) == [100, 100, -1, 0, 0]


def test_scale_with_equal_thresholds(tmp_path):
    file = write_map(tmp_path, GREYS, mode="scale", occupied_thresh=0.2, free_thresh=0.2)
    assert values_of(file) == [100] * 7 + [0] * 3


def test_raw_takes_pixel_values_as_they_are(tmp_path):
    levels = np.array([[0, 25, 26, 64, 65, 100, 101, 255]], np.uint8)
    file = write_map(tmp_path, levels, mode="raw", negate=1)
    assert values_of(file) == [0, 0, -1, -1, 100, 100, -1, -1]


def test_colours_are_averaged(tmp_path):
    pixels = np.array([[(255, 0, 0), (255, 255, 240), (0, 0, 90)]], np.uint8)
    assert values_of(write_map(tmp_path, pixels, image="map.png")) == [100, 0, 100]


def test_trinary_averages_opacity_with_the_colours(tmp_path):
    pixels = np.array(
        [[(0, 0, 0, 255), (0, 0, 0, 0), (255, 255, 255, 255), (255, 255, 255, 0)]], np.uint8
    )
    assert values_of(write_map(tmp_path, pixels, image="map.png")) == [100, 100, 0, -1]


def test_scale_takes_anything_not_opaque_as_unknown(tmp_path):
    pixels = np.array([[(0, 255), (0, 254), (255, 255), (255, 0)]], np.uint8)
    file = write_map(tmp_path, pixels, "LA", image="map.png", mode="scale")
    assert values_of(file) == [100, -1, 0, -1]


@pytest.mark.parametrize("bits", [1, 8, 16])
@pytest.mark.parametrize("suffix", [".png", ".pgm"])
def test_depths_and_palettes(tmp_path, bits, suffix):
    image = Image.fromarray(np.array([[0, 255]], np.uint8))
    if bits == 1:
        image = image.convert("1")
    elif bits == 16:
        image = Image.fromarray(np.array([[0, 65535]], np.uint16))
    image.save(tmp_path / f"map{suffix}")
    (tmp_path / "map.yaml").write_text(yaml.safe_dump({**METADATA, "image": f"map{suffix}"}))
    assert values_of(tmp_path / "map.yaml") == [100, 0]


def test_palette_picture(tmp_path):
    image = Image.fromarray(np.array([[0, 255]], np.uint8)).convert("P")
    image.save(tmp_path / "map.png")
    (tmp_path / "map.yaml").write_text(yaml.safe_dump({**METADATA, "image": "map.png"}))
    assert values_of(tmp_path / "map.yaml") == [100, 0]


@pytest.mark.parametrize(
    "data",
    [
        b"P2\n# made by hand\n3 1\n255\n0 205\n254\n",
        b"P2 3 1 100 0 80 100",
        b"P5\n# CREATOR: map_saver 0.050 m/pix\n3 1\n255\n\x00\xcd\xfe",
        b"P5 3 1 65535\n\x00\x00\xcd\xcd\xfe\xfe",
    ],
)
def test_pgm_variants(tmp_path, data):
    (tmp_path / "map.pgm").write_bytes(data)
    (tmp_path / "map.yaml").write_text(yaml.safe_dump(METADATA))
    assert values_of(tmp_path / "map.yaml") == [100, -1, 0]


def test_relative_and_absolute_image_paths(tmp_path):
    (tmp_path / "images").mkdir()
    file = write_map(tmp_path, GREYS, image="images/map.pgm")
    absolute = {**METADATA, "image": str(tmp_path / "images" / "map.pgm")}
    other = tmp_path / "images" / "other.yaml"
    other.write_text(yaml.safe_dump(absolute))
    assert load_ros_map(file) == load_ros_map(other)


def test_numbers_as_yaml_strings_and_short_origins(tmp_path):
    file = write_map(tmp_path, GREYS, resolution="5e-2", origin=[1, "2e0"])
    assert load_ros_map(file).origin == (1.0, 2.0, 0.0)


@pytest.mark.parametrize(
    ("metadata", "reason"),
    [
        ({"image": 5}, "image"),
        ({"image": ""}, "image"),
        ({"image": "nul\0.pgm"}, "cannot be read"),
        ({"image": "absent.pgm"}, r"absent\.pgm: cannot be read"),
        ({"image": "."}, "cannot be read"),
        ({"mode": "binary"}, "trinary, scale, raw"),
        ({"mode": ["raw"]}, "mode must be"),
        ({"resolution": float("nan")}, "resolution must be a finite number"),
        ({"resolution": -0.05}, "resolution"),
        ({"resolution": 0}, "resolution"),
        ({"resolution": True}, "resolution"),
        ({"resolution": None}, "resolution"),
        ({"resolution": 10**400}, "resolution"),
        ({"origin": [0, 0, float("inf")]}, "origin"),
        ({"origin": [0]}, "origin"),
        ({"origin": 3}, "origin"),
        ({"negate": 2}, "negate"),
        ({"negate": "no"}, "negate"),
        ({"occupied_thresh": 1.5}, r"occupied_thresh must be in \[0, 1\]; got 1\.5"),
        ({"free_thresh": -0.1}, "free_thresh"),
        ({"occupied_thresh": float("nan")}, "occupied_thresh"),
        ({"occupied_thresh": 0.2, "free_thresh": 0.6}, "free_thresh must be at most"),
    ],
)
def test_bad_metadata_names_file_and_reason(tmp_path, metadata, reason):
    Image.fromarray(GREYS).save(tmp_path / "map.pgm")
    file = tmp_path / "map.yaml"
    file.write_text(yaml.safe_dump({**METADATA, **metadata}))
    with pytest.raises(InvalidMap, match=reason) as caught:
        load_ros_map(file)
    assert str(caught.value).startswith(f"{file}: ")


@pytest.mark.parametrize("key", [key for key in METADATA if key != "mode"])
def test_missing_keys_are_named(tmp_path, key):
    file = tmp_path / "map.yaml"
    file.write_text(yaml.safe_dump({k: v for k, v in METADATA.items() if k != key}))
    with pytest.raises(InvalidMap, match=f"missing {key}"):
        load_ros_map(file)


@pytest.mark.parametrize(
    "text",
    [
        *(b"", b"- a\n- b\n", b"text", b"a: [", b"\xff\xfe\x00", b"a: 2001-99-99", b"\0"),
        *(b"[" * 1500, b"a: !!bool x", b"a: !!int ''", b"a: !!float ''", b"a: !!timestamp x"),
    ],
)
def test_damaged_yaml(tmp_path, text):
    file = tmp_path / "map.yaml"
    file.write_bytes(text)
    with pytest.raises(InvalidMap, match=r"map\.yaml: "):
        load_ros_map(file)


@given(st.data())
def test_truncated_pictures_are_errors_not_half_maps(tmp_path_factory, data):
    folder = tmp_path_factory.mktemp("truncated")
    suffix = data.draw(st.sampled_from([".pgm", ".png"]))
    pixels = np.random.default_rng(0).integers(0, 256, (20, 20), np.uint8)
    file = write_map(folder, pixels, image=f"map{suffix}")
    image = folder / f"map{suffix}"
    whole = image.read_bytes()
    # A PNG holds all pixels some bytes before its end.
    longest = len(whole) - (1 if suffix == ".pgm" else 40)
    image.write_bytes(whole[: data.draw(st.integers(0, longest))])
    with pytest.raises(InvalidMap, match="map"):
        load_ros_map(file)


@given(st.data())
def test_damaged_pictures_raise_nothing_but_invalid_map(tmp_path_factory, data):
    folder = tmp_path_factory.mktemp("damaged")
    suffix = data.draw(st.sampled_from([".pgm", ".png"]))
    file = write_map(folder, GREYS, image=f"map{suffix}")
    image = folder / f"map{suffix}"
    content = bytearray(image.read_bytes())
    for _ in range(data.draw(st.integers(1, 4))):
        content[data.draw(st.integers(0, len(content) - 1))] = data.draw(st.integers(0, 255))
    image.write_bytes(bytes(content))
    with contextlib.suppress(InvalidMap):
        assert load_ros_map(file).occupied.size > 0


@given(
    arrays(np.int8, st.tuples(st.integers(1, 9), st.integers(1, 9)), elements=st.integers(-1, 1)),
    st.floats(1e-6, 1e3),
    st.tuples(*[st.floats(-1e6, 1e6)] * 3),
    st.booleans(),
)
def test_saved_maps_come_back_exactly(tmp_path_factory, values, resolution, origin, closed):
    file = tmp_path_factory.mktemp("saved") / "a map: with ü.yaml"
    unknown = values == -1
    grid = OccupancyGrid((values == 1) | (unknown & closed), resolution, origin, unknown)
    save_ros_map(grid, file)
    assert load_ros_map(file, unknown_is_occupied=closed) == grid


def test_saving_leaves_nothing_but_the_two_files(tmp_path):
    for _ in range(2):
        save_ros_map(OccupancyGrid(np.eye(3)), tmp_path / "map.yaml")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["map.pgm", "map.yaml"]


def test_a_failed_save_keeps_the_old_map(tmp_path):
    # While it is written, a file has a longer name: too long a one, for the YAML file alone.
    longest = os.pathconf(tmp_path, "PC_NAME_MAX") - len(f"..{os.getpid()}-01234567.tmp")
    file = tmp_path / ("m" * (longest - len(".pgm")) + ".yaml")
    grid = OccupancyGrid(np.eye(3))
    picture = file.with_suffix(".pgm")
    picture.write_bytes(b"old")
    file.write_bytes(b"old")
    before = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    with pytest.raises(InvalidParameter, match="cannot be written"):
        save_ros_map(OccupancyGrid(np.ones((3, 3))), file)
    after = {path.name: path.read_bytes() for path in tmp_path.iterdir() if path.is_file()}
    assert after == before
    with pytest.raises(InvalidParameter, match="cannot be written"):
        save_ros_map(grid, tmp_path / "absent" / "map.yaml")


@pytest.mark.parametrize(
    ("name", "shape", "origin", "occupied", "unknown"),
    [
        # depot's free_thresh of 0.25 makes the saver's grey 205 free, as in Nav2.
        ("depot", (307, 604), (0.0, 0.0, 0.0), 5947, 0),
        ("tb3_sandbox", (384, 384), (-10.0, -10.0, 0.0), 870, 138683),
        ("mrpb_office02", (600, 600), (-15.0, -15.0, 0.0), 11645, 133985),
        ("mrpb_office02_partially_unknown", (600, 600), (-15.0, -15.0, 0.0), 9483, 171879),
    ],
)
def test_real_maps(real_maps, tmp_path, name, shape, origin, occupied, unknown):
    grid = load_ros_map(real_maps / f"{name}.yaml")
    assert grid.shape == shape
    assert grid.origin == origin
    assert grid.resolution == 0.05
    assert grid.unknown.sum() == unknown
    assert grid.occupied.sum() == occupied + unknown
    save_ros_map(grid, tmp_path / "again.yaml")
    assert load_ros_map(tmp_path / "again.yaml") == grid


@pytest.mark.parametrize("value", ["0x" + 4000 * "f", "1:" + 200 * "0:" + "0.5", 3000 * "9"])
@pytest.mark.parametrize("name", ["negate", "resolution", "mode"])
def test_huge_values_are_refused(tmp_path, name, value):
    file = write_map(tmp_path, GREYS)
    lines = [line for line in file.read_text().splitlines() if not line.startswith(name)]
    file.write_text("\n".join([*lines, f"{name}: {value}"]))
    with pytest.raises(InvalidMap, match=r"map\.yaml"):
        load_ros_map(file)
    assert map_files(tmp_path) == sorted(tmp_path.iterdir())  # the picture is nobody's
