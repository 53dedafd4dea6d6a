from __future__ import annotations

import json

import pytest

import planformer as pf


def test_map_is_the_generators(cli, tmp_path):
    generators = {
        "indoor": pf.generate_indoor,
        "forest": pf.generate_forest,
        "maze": pf.generate_maze,
    }
    for kind, generate in generators.items():
        file = tmp_path / kind / "map.yaml"
        size = ("--seed", 3, "--width", 9, "--height", 8, "--output", file)
        result = cli("map", kind, *size, "--json")
        assert result.exit_code == 0, result.output
        assert json.loads(result.stdout)["width"] == 9
        assert pf.load_map(file) == generate(3, width=9, height=8)


@pytest.mark.parametrize(
    "options", [("--width", "-1"), ("--output", "map.xyz"), ("--resolution", "1e-9")]
)
def test_map_refuses_bad_input(cli, tmp_path, monkeypatch, options):
    monkeypatch.chdir(tmp_path)
    assert cli("map", "forest", "--output", "map.yaml", *options).exit_code == 2
    assert not list(tmp_path.iterdir())


def test_info_lists_planners_and_guides(cli):
    record = json.loads(cli("info", "--json").stdout)
    assert record["planformer"] == pf.__version__
    assert record["planners"]["point"] == pf.planner_names(pf.PointRobot())
    assert "SST" in record["planners"]["dubins"]
    assert list(record["guides"]) == pf.guide_names()
    assert "RRTstar" in cli("info").output


def test_info_describes_a_map(cli, room, room_file):
    record = json.loads(cli("info", room_file, "--json").stdout)
    assert record["shape"] == list(room.shape)
    assert record["origin"] == list(room.origin)
    assert record["occupied"] == pytest.approx(room.occupied.mean())
    assert "60 x 40 cells" in cli("info", room_file).output


def test_version_and_help(cli):
    assert pf.__version__ in cli("--version").output
    for command in ("plan", "map", "info", "generate", "train", "export"):
        result = cli(command, "--help")
        assert result.exit_code == 0
        assert result.output.strip()


def test_generate_completes_only_its_own_data_set(cli, tmp_path):
    options = ("--kinds", "forest", "--maps", 1, "--paths-per-map", 2, "--workers", 1)
    first = cli("generate", tmp_path / "data", *options, "--json")
    assert first.exit_code == 0, first.output
    assert json.loads(first.stdout)["kinds"] == ["forest"]
    assert cli("generate", tmp_path / "data", *options).exit_code == 0
    other = cli("generate", tmp_path / "data", *options, "--seed", 5)
    assert other.exit_code == 2
    assert "other settings (seed 0, not 5)" in other.output


def test_generate_for_a_car_on_maps_of_ones_own(cli, room_file, tmp_path):
    (tmp_path / "maps").mkdir()
    for file in (room_file, room_file.with_suffix(".pgm")):
        file.rename(tmp_path / "maps" / file.name)
    options = ("--robot", "dubins", "--radius", 0.05, "--turning-radius", 0.2, "--workers", 1)
    distances = ("--min-distance", 0.5, "--max-distance", 2, "--paths-per-map", 3)
    arguments = (tmp_path / "data", "--maps-from", tmp_path / "maps", *options, *distances)
    result = cli("generate", *arguments)
    assert result.exit_code == 0, result.output
    record = json.loads(cli("generate", *arguments, "--json").stdout)
    assert (record["kinds"], record["turning_radius"]) == ([], 0.2)
    assert [name for name, _ in record["user_maps"]] == ["room.yaml"]


def test_generate_refuses_what_it_cannot_do(cli, tmp_path):
    for options, reason in (
        ((), "say how many maps"),
        (("--preset", "paper", "--radius", "0.3"), "fixes robot_radius"),
        (("--preset", "forest"), "choose from paper, paper-dubins"),
        (("--maps", "1", "--kinds", "swamp"), "forest, indoor, maze"),
        (("--maps", "1", "--expert", "oracle"), "lazy-theta"),
        (("--maps-from", tmp_path / "none"), "holds no map"),
    ):
        result = cli("generate", tmp_path / "data", *options)
        assert result.exit_code == 2
        assert reason in " ".join(result.output.split())
    assert not (tmp_path / "data").exists()


def test_generate_takes_a_preset_and_less_of_it(cli, tmp_path):
    options = ("--preset", "paper", "--maps", 1, "--paths-per-map", 2, "--workers", 1, "--json")
    record = json.loads(cli("generate", tmp_path / "data", *options).stdout)
    assert record["kinds"] == ["forest", "maze"]
    assert (record["maps"], record["paths_per_map"], record["width"]) == (1, 2, 24.0)


def test_training_to_guidance(cli, shell, tmp_path):
    """Every command in turn, from maps to a guided plan."""
    pytest.importorskip("torch")
    pytest.importorskip("onnx")
    for part, seed in (("train", 1), ("val", 2)):
        options = ("--kinds", "forest", "--maps", 1, "--paths-per-map", 4, "--workers", 1)
        assert cli("generate", tmp_path / "data" / part, *options, "--seed", seed).exit_code == 0
    settings = ("--preset", "tiny", "--steps", 1, "--batch-size", 2, "--workers", 0)
    trained = shell("train", tmp_path / "data", tmp_path / "run", *settings, "--json")
    assert trained.returncode == 0, trained.stderr
    checkpoint = json.loads(trained.stdout)["checkpoint"]
    weights = tmp_path / "tiny.onnx"
    exported = cli("export", checkpoint, weights, "--json")
    assert exported.exit_code == 0, exported.output
    assert weights.with_suffix(".json").is_file()
    map_file = tmp_path / "map.yaml"
    assert cli("map", "forest", "--seed", 4, "--output", map_file).exit_code == 0
    grid = pf.load_map(map_file)
    ends = [
        value
        for option, point in (("--start", (1, 1)), ("--goal", (6, 6)))
        for value in (option, *grid.nearest_free(point, 0.1))
    ]
    plan = cli("plan", map_file, *ends, "--guide", weights, "--time-limit", 2, "--json")
    record = json.loads(plan.stdout)
    assert plan.exit_code in (0, 1)
    assert 0 < record["region"]["share"] <= 1
