from __future__ import annotations

import math

import numpy as np
import pytest

from planformer.errors import InvalidMap
from planformer.maps import OccupancyGrid, Scenario, load_map, load_scenarios
from planformer.maps.movingai import load_movingai_map

TEXT = "type octile\nheight 3\nwidth 4\nmap\n.GS@\nOTW.\n....\n"
SCENARIO = "version 1\n0\tsmall.map\t4\t3\t0\t2\t3\t1\t3.41421356\n"


def write(folder, text, name="small.map"):
    file = folder / name
    file.write_bytes(text if isinstance(text, bytes) else text.encode())
    return file


@pytest.mark.parametrize("end", ["\n", "\r\n"])
@pytest.mark.parametrize("tail", ["", "\n\n", None])
def test_terrain_and_orientation(tmp_path, end, tail):
    text = TEXT.rstrip("\n") if tail is None else TEXT + tail
    grid = load_movingai_map(write(tmp_path, text.replace("\n", end)), resolution=0.5)
    assert grid.resolution == 0.5
    assert not grid.unknown.any()
    np.testing.assert_array_equal(grid.occupied[::-1], [[0, 0, 0, 1], [1, 1, 1, 0], [0, 0, 0, 0]])


def test_header_lines_in_another_order(tmp_path):
    text = TEXT.replace("height 3\nwidth 4", "width 4\nheight 3")
    assert load_movingai_map(write(tmp_path, text)) == load_movingai_map(write(tmp_path, TEXT))


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("", "not a MovingAI map"),
        ("hello\nworld\n", "not a MovingAI map"),
        (TEXT.replace("type octile\n", ""), "type octile"),
        (TEXT.replace("height 3\n", ""), "height"),
        (TEXT.replace("width 4\n", ""), "width"),
        (TEXT.replace("height 3", "height 0"), "height"),
        (TEXT.replace("width 4", "width -4"), "width"),
        (TEXT.replace("width 4", "width four"), "width"),
        (TEXT.replace("width 4", "width 99999999999999"), "width"),
        (TEXT.replace("height 3", "height 4"), "3 rows, its header says 4"),
        (TEXT.replace("height 3", "height 2"), "3 rows, its header says 2"),
        (TEXT[:-3], "row 2 has 2 cells"),
        (TEXT.replace("width 4", "width 5"), "row 0 has 4 cells"),
        (TEXT.replace("OTW.", "OTX."), "row 1, column 2 holds 'X'"),
        (TEXT.encode().replace(b"OTW.", b"OT\xff."), "row 1, column 2"),
    ],
)
def test_damaged_maps_name_file_and_reason(tmp_path, text, reason):
    with pytest.raises(InvalidMap, match=reason) as caught:
        load_movingai_map(write(tmp_path, text))
    assert "small.map" in str(caught.value)


def test_bad_resolution_names_the_file(tmp_path):
    with pytest.raises(InvalidMap, match=r"small\.map: resolution"):
        load_movingai_map(write(tmp_path, TEXT), resolution=math.nan)


@pytest.mark.parametrize("version", ["version 1", "version 1.0"])
def test_scenarios(tmp_path, version):
    text = SCENARIO.replace("version 1", version) + "\n"
    (scenario,) = load_scenarios(write(tmp_path, text, "small.map.scen"))
    assert scenario == Scenario(0, "small.map", 4, 3, (0, 2), (3, 1), 3.41421356)
    grid = load_movingai_map(write(tmp_path, TEXT), resolution=1.0)
    assert scenario.start_and_goal(grid) == ((0.5, 0.5), (3.5, 1.5))


def test_scenarios_may_be_separated_by_spaces(tmp_path):
    file = write(tmp_path, SCENARIO.replace("\t", "  "), "small.map.scen")
    assert load_scenarios(file)[0].map_name == "small.map"


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("", "version 1"),
        ("version 2\n", "version 1"),
        (SCENARIO + "1\tsmall.map\t4\t3\n", "line 3"),
        (SCENARIO.replace("\t4\t", "\tx\t"), "line 2"),
        (SCENARIO.replace("\t3\t1\t", "\t4\t1\t"), r"line 2: the goal \(4, 1\) lies outside"),
        (SCENARIO.replace("\t0\t2\t", "\t-1\t2\t"), "the start"),
        (SCENARIO.replace("3.41421356", "nan"), "optimal length"),
    ],
)
def test_damaged_scenarios_name_file_and_line(tmp_path, text, reason):
    with pytest.raises(InvalidMap, match=reason) as caught:
        load_scenarios(write(tmp_path, text, "small.map.scen"))
    assert "small.map.scen" in str(caught.value)


def test_a_scenario_needs_its_own_map():
    scenario = Scenario(0, "small.map", 4, 3, (0, 2), (3, 1), 3.4)
    with pytest.raises(InvalidMap, match=r"small\.map, 4 x 3 cells; the grid has 3 x 4"):
        scenario.start_and_goal(OccupancyGrid(np.zeros((4, 3))))


@pytest.mark.parametrize("name", ["32room_000", "NewYork_0_512", "maze512-32-0"])
def test_starts_and_goals_of_real_maps_are_free(real_maps, name):
    grid = load_map(real_maps / f"{name}.map", resolution=1.0)
    assert grid.shape == (512, 512)
    scenarios = load_scenarios(real_maps / f"{name}.map.scen")
    assert len(scenarios) > 1000
    for scenario in scenarios:
        start, goal = scenario.start_and_goal(grid)
        rows, columns = grid.to_rc([start, goal]).T
        assert not grid.occupied[rows, columns].any()
        assert math.dist(start, goal) <= scenario.optimal_length * (1 + 1e-5)
