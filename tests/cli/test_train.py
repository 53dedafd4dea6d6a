from __future__ import annotations

import json

import pytest

pytest.importorskip("torch", reason="training needs PyTorch")

SETTINGS = [
    "--preset",
    "tiny",
    "--batch-size",
    "2",
    "--workers",
    "0",
    "--threads",
    "1",
    "--validate-every",
    "1",
]


@pytest.fixture(scope="module")
def data(tmp_path_factory):
    from planformer.data.generate import generate_dataset

    folder = tmp_path_factory.mktemp("data")
    for part, seed in (("train", 0), ("val", 1)):
        generate_dataset(
            folder / part, kinds=["forest"], maps=1, paths_per_map=2, seed=seed, workers=1
        )
    return folder


def test_a_training_leaves_checkpoint_log_and_curve(cli, data, tmp_path):
    done = cli("train", data, tmp_path, *SETTINGS, "--steps", 2)
    assert done.exit_code == 0, done.output
    assert {path.name for path in tmp_path.iterdir()} == {"checkpoint.pt", "curve.png", "log.csv"}
    assert (tmp_path / "curve.png").read_bytes().startswith(b"\x89PNG")
    assert "step 2  all: " in done.output
    more = cli("train", data, tmp_path, *SETTINGS, "--steps", 3, "--json")
    assert json.loads(more.stdout)["step"] == 3


def test_weights_start_another_training_and_teach_a_third(cli, data, tmp_path):
    first = cli("train", data, tmp_path / "a", *SETTINGS, "--steps", 1, "--json")
    checkpoint = json.loads(first.stdout)["checkpoint"]
    for folder, option in (("b", "--initial"), ("c", "--teacher")):
        settings = (*SETTINGS, "--steps", 1, "--seed", 7, option, checkpoint)
        done = cli("train", data, tmp_path / folder, *settings)
        assert done.exit_code == 0, done.output


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--batch-size", 1), "another folder"),
        (("--preset", "small"), "another network"),
        (("--steps", 40, "--learning-rate", 1e30), "another folder"),
        (("--initial", "no.pt", "--steps", 0), "steps"),
        (("--recipe", "paper", "--learning-rate", 1e-4), "the recipe 'paper'; got 0.0001"),
        (("--preset", "dubins"), "of a car; the data set's are of a point robot"),
    ],
)
def test_says_why_it_does_not_go_on(cli, data, tmp_path, options, message):
    assert cli("train", data, tmp_path, *SETTINGS, "--steps", 1).exit_code == 0
    done = cli("train", data, tmp_path, *SETTINGS, "--steps", 2, *options)
    assert done.exit_code == 2
    assert message in done.output
    assert "Traceback" not in done.output


def test_a_diverging_training_ends_with_a_line(cli, data, tmp_path):
    done = cli("train", data, tmp_path, *SETTINGS, "--steps", 40, "--learning-rate", 1e30)
    assert done.exit_code == 2
    assert "no finite number" in done.output


def test_several_devices_speak_once(shell, data, tmp_path):
    pytest.importorskip("lightning_fabric", reason="several devices need Lightning Fabric")
    done = shell("train", data, tmp_path, *SETTINGS, "--steps", 2, "--devices", 2, "--json")
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)["step"] == 2
    assert done.stderr.count("step 2  all: ") == 1


def test_maps_of_the_training_in_the_validation_are_told_of(cli, data, tmp_path):
    for part in ("train", "val"):
        (tmp_path / part).symlink_to(data / "train")
    done = cli("train", tmp_path, tmp_path / "run", *SETTINGS, "--steps", 1)
    assert done.exit_code == 0, done.output
    assert "1 of the 1 maps in val/ are in train/ too" in done.output
    assert "warning" not in cli("train", data, tmp_path / "other", *SETTINGS, "--steps", 1).output
