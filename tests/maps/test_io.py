from __future__ import annotations

import io
import os
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from planformer.errors import InvalidMap, InvalidParameter
from planformer.maps import OccupancyGrid, generate_indoor, load_map, save_map

OCCUPIED = np.array([[1, 0, 0], [0, 0, 1]], bool)


def _header(shape: tuple[int, ...]) -> bytes:
    """The beginning of an array file."""
    file = io.BytesIO()
    np.lib.format.write_array_header_1_0(
        file, {"descr": "|b1", "fortran_order": False, "shape": shape}
    )
    return file.getvalue()


@pytest.mark.parametrize("suffix", [".npy", ".png", ".yaml", ".yml", ".YAML"])
def test_saved_maps_come_back(tmp_path, suffix):
    file = tmp_path / f"map{suffix}"
    save_map(OccupancyGrid(OCCUPIED, 0.05), file)
    assert load_map(file) == OccupancyGrid(OCCUPIED, 0.05)
    assert load_map(str(file)) == load_map(file)


def test_yaml_keeps_what_a_generated_map_has(tmp_path):
    grid = generate_indoor(4, width=12, height=9)
    save_map(grid, tmp_path / "map.yaml")
    assert load_map(tmp_path / "map.yaml") == grid


@pytest.mark.parametrize("suffix", [".npy", ".png"])
def test_resolution_of_formats_without_one(tmp_path, suffix):
    file = tmp_path / f"map{suffix}"
    save_map(OccupancyGrid(OCCUPIED), file)
    assert load_map(file).resolution == 0.05
    assert load_map(file, resolution=0.2).resolution == 0.2
    with pytest.raises(InvalidMap, match=rf"map\{suffix}: resolution"):
        load_map(file, resolution=-1.0)


def test_a_yaml_file_has_its_own_resolution(tmp_path):
    save_map(OccupancyGrid(OCCUPIED), tmp_path / "map.yaml")
    with pytest.raises(InvalidParameter, match="its own resolution"):
        load_map(tmp_path / "map.yaml", resolution=0.1)


@pytest.mark.parametrize("suffix", [".png", ".bmp", ".pgm", ".gif", ".tif", ".jpg"])
def test_dark_pixels_of_a_picture_are_occupied(tmp_path, suffix):
    pixels = np.zeros((16, 32), np.uint8)
    pixels[:8] = 255
    Image.fromarray(pixels).save(tmp_path / f"map{suffix}")
    grid = load_map(tmp_path / f"map{suffix}")
    np.testing.assert_array_equal(grid.occupied[::-1], pixels < 128)


@pytest.mark.parametrize("unknown_is_occupied", [True, False])
def test_transparent_pixels_are_unknown(tmp_path, unknown_is_occupied):
    pixels = np.array([[(0, 0, 0, 0), (255, 255, 255, 0), (0, 0, 0, 255), (255, 255, 255, 255)]])
    Image.fromarray(pixels.astype(np.uint8)).save(tmp_path / "map.png")
    grid = load_map(tmp_path / "map.png", unknown_is_occupied=unknown_is_occupied)
    assert grid.unknown.tolist() == [[True, True, False, False]]
    assert grid.occupied.tolist() == [[unknown_is_occupied, unknown_is_occupied, True, False]]


@pytest.mark.parametrize("dtype", [bool, np.uint8, np.int64, np.float32])
def test_arrays_of_any_number_type(tmp_path, dtype):
    np.save(tmp_path / "map.npy", OCCUPIED.astype(dtype))
    np.testing.assert_array_equal(load_map(tmp_path / "map.npy").occupied, OCCUPIED)


@pytest.mark.parametrize(
    "array", [np.array([[0.0, np.nan]]), np.zeros(3), np.array([[2]]), np.array([["a"]])]
)
def test_arrays_that_are_no_map(tmp_path, array):
    np.save(tmp_path / "map.npy", array)
    with pytest.raises(InvalidMap, match=r"map\.npy: occupied"):
        load_map(tmp_path / "map.npy")


@pytest.mark.parametrize(
    "data", [b"PK\x03\x04 but no archive", _header((10**6, 10**6)), _header((10**30, 1))]
)
def test_damaged_arrays_are_refused(tmp_path, data):
    (tmp_path / "map.npy").write_bytes(data)
    with pytest.raises(InvalidMap, match=r"map\.npy: not a NumPy array"):
        load_map(tmp_path / "map.npy")


def test_pickled_arrays_are_refused(tmp_path):
    np.save(tmp_path / "map.npy", np.array([[{}]]), allow_pickle=True)
    with pytest.raises(InvalidMap, match=r"map\.npy: not a NumPy array"):
        load_map(tmp_path / "map.npy")


@pytest.mark.parametrize("suffix", [".npy", ".png", ".map", ".yaml", ".jpg", ".pgm"])
@pytest.mark.parametrize("content", [b"", b"\x00", b"nonsense" * 50, b"\x93NUMPY\x01\x00", b"P5\n"])
def test_nonsense_names_the_file(tmp_path, suffix, content):
    file = tmp_path / f"map{suffix}"
    file.write_bytes(content)
    with pytest.raises(InvalidMap) as caught:
        load_map(file)
    assert str(file) in str(caught.value)


@pytest.mark.parametrize("suffix", [".npy", ".png", ".map", ".yaml"])
def test_missing_files_and_directories(tmp_path, suffix):
    file = tmp_path / f"map{suffix}"
    with pytest.raises(InvalidMap, match="No such file"):
        load_map(file)
    file.mkdir()
    with pytest.raises(InvalidMap, match="directory"):
        load_map(file)
    with pytest.raises(InvalidParameter, match="cannot be written"):
        save_map(OccupancyGrid(OCCUPIED), file if suffix != ".map" else tmp_path / "no" / "a.npy")


@pytest.mark.skipif(os.geteuid() == 0, reason="root may read everything")
def test_permission_denied(tmp_path):
    file = tmp_path / "map.png"
    save_map(OccupancyGrid(OCCUPIED), file)
    file.chmod(0)
    with pytest.raises(InvalidMap, match="Permission denied"):
        load_map(file)


def test_unknown_suffixes_list_the_known_ones(tmp_path):
    with pytest.raises(InvalidMap, match=r"'\.txt'.*\.yaml.*\.map.*\.npy.*\.png"):
        load_map(tmp_path / "map.txt")
    with pytest.raises(InvalidParameter, match=r"'\.jpg'.*\.yaml.*\.npy.*\.png"):
        save_map(OccupancyGrid(OCCUPIED), tmp_path / "map.jpg")
    with pytest.raises(InvalidMap, match="''"):
        load_map(tmp_path)


def test_gigantic_pictures_are_refused(tmp_path, monkeypatch):
    file = tmp_path / "map.png"
    save_map(OccupancyGrid(np.zeros((40, 40))), file)
    monkeypatch.setattr(Image, "MAX_IMAGE_PIXELS", 1000)  # a warning from there on
    assert load_map(file).shape == (40, 40)
    monkeypatch.setattr(Image, "MAX_IMAGE_PIXELS", 100)  # an error from twice as many on
    with pytest.raises(InvalidMap, match=r"map\.png: the image is too large"):
        load_map(file)


def test_every_real_map_loads(real_maps: Path):
    files = [file for file in sorted(real_maps.iterdir()) if file.suffix != ".scen"]
    assert len(files) >= 11
    for file in files:
        grid = load_map(file)
        assert 0.0 < grid.occupied.mean() < 1.0
        assert grid.clearance.max() > 0.5
