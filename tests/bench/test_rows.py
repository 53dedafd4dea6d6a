from __future__ import annotations

import pytest

from planformer.bench.rows import all_rows, chosen_rows
from planformer.errors import InvalidParameter


def test_rows_have_the_sizes_of_their_names():
    sizes = {"480": (480, 480), "360x240": (360, 240), "480x240": (480, 240)}
    sizes |= {"560": (560, 560), "780": (780, 780)}
    rows = all_rows()
    assert {"forest-480", "maze-480", "indoor-480", "maze-780", "dubins-forest-480"} < set(rows)
    for name, row in rows.items():
        width, height = sizes[name.rsplit("-", 1)[1]]
        grid = row.scenes[0].maps.grid(1)
        assert grid.shape == (height, width), name
        assert grid.resolution == 0.05


def test_rows_are_chosen_in_the_order_asked_for():
    assert [row.name for row in chosen_rows(["maze-480", "forest-480", "maze-480"])] == [
        "maze-480",
        "forest-480",
    ]
    with pytest.raises(InvalidParameter, match="unknown rows swamp; choose from forest-480"):
        chosen_rows(["forest-480", "swamp"])


def test_real_maps_need_their_folder(tmp_path, real_maps):
    with pytest.raises(InvalidParameter, match="folder of the maps"):
        chosen_rows(["real-depot"])
    with pytest.raises(InvalidParameter, match=r"lacks the maps depot\.yaml"):
        chosen_rows(None, tmp_path)
    (row,) = chosen_rows(["real-depot"], real_maps)
    grids = [scene.maps.grid(0) for scene in row.scenes]
    assert {grid.resolution for grid in grids} == {0.025, 0.05, 0.1}
    assert {scene.robot.radius for scene in row.scenes} == {0.1, 0.2, 0.3}
    assert max(grid.width for grid in grids) - min(grid.width for grid in grids) < 0.1
    assert len({scene.name for scene in row.scenes}) == 9
