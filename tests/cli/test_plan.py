from __future__ import annotations

import csv
import json

import numpy as np
import pytest
from PIL import Image

import planformer as pf

ENDS = ("--start", -1.2, -0.6, "--goal", "1.2", "-0.6")
CAR_ENDS = ("--start", -1.2, -0.6, 1.57, "--goal", 1.2, -0.6, -1.57)


def read_csv(path):
    with path.open(newline="") as file:
        header, *rows = csv.reader(file)
    return header, np.array(rows, float)


def test_writes_path_record_and_picture(cli, room, room_file, tmp_path):
    folder = tmp_path / "new" / "folder"
    result = cli(
        "plan", room_file, *ENDS, "--guide", "none", "--time-limit", 0.5, "--output", folder
    )
    assert result.exit_code == 0, result.output
    assert sorted(path.name for path in folder.iterdir()) == [
        "path.csv",
        "path.json",
        "picture.png",
    ]
    record = json.loads((folder / "path.json").read_text())
    header, path = read_csv(folder / "path.csv")
    assert header == ["x", "y"]
    np.testing.assert_array_equal(path, record["path"])
    np.testing.assert_array_equal(path[[0, -1]], [(-1.2, -0.6), (1.2, -0.6)])
    assert pf.path_is_valid(room, pf.PointRobot(), path)
    with Image.open(folder / "picture.png") as picture:
        picture.verify()
    for word in ("path found", f"{record['length']:.3f} m", str(record["seed"]), "picture.png"):
        assert word in result.output


def test_default_folder_is_named_after_the_map(cli, room_file, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    options = ("--guide", "none", "--planner", "RRTConnect", "--no-picture")
    assert cli("plan", room_file, *ENDS, *options).exit_code == 0
    assert sorted(path.name for path in (tmp_path / "room_plan").iterdir()) == [
        "path.csv",
        "path.json",
    ]


def test_json_is_all_that_is_printed_and_nothing_is_written(shell, room_file, tmp_path):
    options = ("--guide", "none", "--planner", "RRTConnect", "--json")
    before = sorted(tmp_path.iterdir())
    done = shell("plan", room_file, *ENDS, *options, cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    assert json.loads(done.stdout)["files"] == {}
    assert sorted(tmp_path.iterdir()) == before


def test_record_repeats_the_plan(plan_json, room_file):
    first_code, first = plan_json(room_file, *ENDS, "--max-vertices", 300)
    code, again = plan_json(room_file, *ENDS, "--max-vertices", 300, "--seed", first["seed"])
    assert first_code == code == 0
    assert first["status"] == "vertex limit"
    assert again["path"] == first["path"]


def test_target_length_ends_the_search(plan_json, room_file):
    code, record = plan_json(room_file, *ENDS, "--target-length", 5, "--time-limit", 60)
    assert (code, record["status"]) == (0, "target reached")
    assert record["length"] <= 5


@pytest.mark.parametrize(
    ("kind", "robot"),
    [
        ("dubins", pf.DubinsCar(radius=0.1, turning_radius=0.3)),
        ("reeds-shepp", pf.ReedsSheppCar(radius=0.1, turning_radius=0.3)),
    ],
)
def test_cars(cli, room, room_file, tmp_path, kind, robot):
    options = ("--robot", kind, "--radius", 0.1, "--turning-radius", 0.3, "--guide", "none")
    limit = ("--target-length", 100, "--time-limit", 30, "--seed", 1)
    result = cli("plan", room_file, *CAR_ENDS, *options, *limit, "--output", tmp_path)
    assert result.exit_code == 0, result.output
    header, path = read_csv(tmp_path / "path.csv")
    assert header == ["x", "y", "yaw"]
    assert pf.path_is_valid(room, robot, path)
    assert json.loads((tmp_path / "path.json").read_text())["robot"]["turning_radius"] == 0.3


def test_no_path_is_exit_code_1_and_replaces_an_older_path(cli, tmp_path):
    occupied = np.zeros((20, 41), bool)
    occupied[:, 20] = True
    np.save(tmp_path / "split.npy", occupied)
    ends = ("--start", 0.5, 0.5, "--goal", 1.5, 0.5)
    (tmp_path / "path.csv").write_text("x,y\n1,2\n")
    result = cli("plan", tmp_path / "split.npy", *ends, "--guide", "none", "--output", tmp_path)
    assert result.exit_code == 1
    assert "no path: unreachable" in result.output
    assert (tmp_path / "path.csv").read_text() == "x,y\n"
    record = json.loads((tmp_path / "path.json").read_text())
    assert (record["solved"], record["length"], record["path"]) == (False, None, [])
    assert (tmp_path / "picture.png").exists()


def test_unknown_space_is_closed_unless_opened(plan_json, tmp_path):
    unknown = np.zeros((20, 40), bool)
    unknown[:, 15:25] = True
    pf.save_map(pf.OccupancyGrid(unknown, unknown=unknown), tmp_path / "half.yaml")
    ends = ("--start", 0.4, 0.5, "--goal", 1.6, 0.5, "--planner", "RRTConnect")
    assert plan_json(tmp_path / "half.yaml", *ends)[0] == 1
    assert plan_json(tmp_path / "half.yaml", *ends, "--unknown-is-free")[0] == 0


def test_resolution_scales_a_map_without_one(plan_json, tmp_path):
    np.save(tmp_path / "field.npy", np.zeros((20, 40), bool))
    ends = ("--start", 1, 1, "--goal", 7, 3, "--planner", "RRTConnect")
    code, record = plan_json(tmp_path / "field.npy", *ends, "--resolution", 0.2)
    assert code == 0
    assert record["map"]["resolution"] == 0.2


def test_occupied_start_names_the_nearest_free_point(shell, room, room_file):
    done = shell("plan", room_file, "--start", 0.02, -0.5, "--goal", 1.2, -0.6, "--guide", "none")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.count("\n") == 1
    x, y = room.nearest_free((0.02, -0.5), 0.1)
    assert done.stderr.startswith("error: ")
    assert f"({x:.3f}, {y:.3f})" in done.stderr


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (("--planner", "RRTstarr"), "RRTstarr"),
        (("--guide", "mptt"), "mptt"),
        (("--turning-radius", "1"), "--turning-radius"),
        (("--radius", "-1"), "radius"),
        (("--robot", "dubins"), "(x, y, yaw)"),
        (("--exploration", "2"), "exploration"),
        (("--time-limit", "0"), "seconds"),
        (("--seed", "-3"), "seed"),
        (("--resolution", "0.1"), "resolution"),
        (("--start", "99", "0"), "outside the map"),
        (("--start", "nan", "0"), "finite"),
        (("--start", "1"), "X Y"),
        (("--robot", "boat"), "boat"),
    ],
)
def test_bad_input_is_exit_code_2(cli, room_file, tmp_path, options, words):
    folder = tmp_path / "out"
    result = cli("plan", room_file, *ENDS, "--guide", "none", "--output", folder, *options)
    assert result.exit_code == 2
    assert words in result.output
    assert not folder.exists()


def test_missing_and_damaged_maps(cli, room_file, tmp_path):
    room_file.with_suffix(".pgm").write_bytes(b"P5\n60 40\n255\nshort")
    for name in ("room.yaml", "nowhere.yaml", "map.xyz"):
        result = cli("plan", tmp_path / name, *ENDS)
        assert result.exit_code == 2
        assert name in result.output


def test_output_that_cannot_be_a_folder_is_refused_before_the_search(cli, room_file):
    result = cli("plan", room_file, *ENDS, "--guide", "none", "--output", room_file / "out")
    assert result.exit_code == 2
    assert "not a folder" in result.output
    assert "vertices" not in result.output


def test_a_learned_planner_has_no_guide(cli, room_file, tmp_path):
    options = ("--planner", "MPNet", "--time-limit", 60, "--no-picture", "--output", tmp_path)
    done = cli("plan", room_file, *ENDS, *options)
    assert done.exit_code == 0, done.output
    assert "MPNet unguided" in done.output
    assert json.loads((tmp_path / "path.json").read_text())["guide"] is None
    for option in (("--guide", "mpt"), ("--threshold", 0.5), ("--exploration", 0.5)):
        refused = cli("plan", room_file, *ENDS, *options, *option)
        assert refused.exit_code == 2
        assert "MPNet plans by itself" in refused.output


def test_the_picture_of_a_ros_map_is_not_taken_for_the_map(cli, room_file, tmp_path):
    picture = room_file.with_suffix(".pgm")
    refused = cli("plan", picture, *ENDS, "--output", tmp_path / "plan")
    assert refused.exit_code == 2
    assert "room.pgm belongs to" in refused.output
    alone = cli("plan", picture, *ENDS, "--output", tmp_path / "plan", "--resolution", 0.05)
    assert "outside the map" in alone.output  # whose origin the picture does not know
