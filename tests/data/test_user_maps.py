from __future__ import annotations

import numpy as np
import pytest

from planformer.data.user_maps import map_files, read_user_maps
from planformer.errors import InvalidMap, InvalidParameter
from planformer.maps import load_map

FILES = ["bench.map", "floors/rooms.npy", "office.yaml", "picture.png"]


def read(folder, *, resolution=0.05, robot_radius=0.1, min_distance=2.0, max_distance=None):
    return read_user_maps(
        folder,
        resolution=resolution,
        robot_radius=robot_radius,
        min_distance=min_distance,
        max_distance=max_distance,
    )


def test_every_map_counts_once_in_order(own_maps):
    names = [file.relative_to(own_maps).as_posix() for file in map_files(own_maps)]
    assert names == FILES  # office.pgm belongs to office.yaml


def test_cells_are_those_of_the_file_and_its_resolution_is_kept(own_maps):
    maps = read(own_maps, resolution=0.07)
    assert [own.name for own in maps] == FILES
    assert [own.resolution for own in maps] == [0.07, 0.07, 0.1, 0.07]
    for own in maps:
        grid = load_map(own_maps / own.name)
        np.testing.assert_array_equal(own.grid().occupied, grid.occupied)
        assert own.shape == grid.shape
        assert own.grid().origin == (0.0, 0.0, 0.0)


def test_real_maps_can_be_used(real_maps):
    maps = read(real_maps, resolution=0.2)
    assert {"depot.yaml", "tb3_sandbox.yaml", "maze512-32-0.map"} <= {own.name for own in maps}
    assert not any(own.name.endswith(".pgm") for own in maps)


def test_a_map_that_cannot_be_read_is_named(own_maps):
    (own_maps / "torn.png").write_bytes((own_maps / "picture.png").read_bytes()[:60])
    with pytest.raises(InvalidMap, match=r"torn\.png"):
        read(own_maps)


def test_a_picture_of_a_broken_yaml_file_is_an_error_of_the_yaml_file(own_maps):
    (own_maps / "office.yaml").write_text("image: [", encoding="ascii")
    with pytest.raises(InvalidMap, match=r"office\.yaml"):
        read(own_maps)


@pytest.mark.parametrize("limits", [{"robot_radius": 30.0}, {"min_distance": 90.0}])
def test_a_map_without_room_is_named(own_maps, limits):
    with pytest.raises(InvalidMap, match=r"bench\.map cannot be used"):
        read(own_maps, **limits)


def test_a_folder_without_maps_is_an_error(own_maps, tmp_path):
    with pytest.raises(InvalidParameter, match="holds no map"):
        read(tmp_path / "none")
    for name in (*FILES, "office.pgm"):
        (own_maps / name).unlink()
    with pytest.raises(InvalidParameter, match="holds no map"):
        read(own_maps)


def test_near_ends_are_found_on_a_large_map_too(tmp_path):
    np.save(tmp_path / "site.npy", np.zeros((2000, 2000), bool))
    (site,) = read(tmp_path, resolution=0.2, min_distance=4.0, max_distance=15.0)
    assert site.shape == (2000, 2000)
