from __future__ import annotations

import json
import signal

import pytest

pytest.importorskip("torch", reason="training needs PyTorch")


@pytest.fixture(scope="module")
def data(tmp_path_factory):
    from planformer.data.generate import generate_dataset

    folder = tmp_path_factory.mktemp("data")
    for part, seed in (("train", 0), ("val", 1)):
        generate_dataset(
            folder / part, kinds=["forest"], maps=8, paths_per_map=1, seed=seed, workers=1
        )
    return folder


@pytest.mark.parametrize("preset", ["mpnet", "next-ks"])
def test_a_planner_is_trained_and_exported(cli, data, tmp_path, preset):
    settings = ("--preset", preset, "--threads", 1, "--validate-every", 1)
    done = cli("train", data, tmp_path / "run", *settings, "--steps", 1)
    assert done.exit_code == 0, done.output
    assert "step 1  validation loss" in done.output
    more = cli("train", data, tmp_path / "run", *settings, "--steps", 2, "--json")
    record = json.loads(more.stdout)
    assert (record["step"], record["finished"]) == (2, True)
    file = tmp_path / "planner.onnx"
    made = cli("export", record["checkpoint"], file, "--json")
    assert made.exit_code == 0, made.output
    assert json.loads(made.stdout)["weights"] == str(file)
    assert file.is_file()


def test_without_a_validation_there_is_no_loss_to_print(cli, data, tmp_path):
    from planformer.training import open_paths
    from planformer.training.mpnet import train_mpnet
    from planformer.training.mpnet_config import MPNetTrainConfig

    train_mpnet(
        MPNetTrainConfig(steps=9, threads=1),
        open_paths(data / "train"),
        tmp_path,
        validation=open_paths(data / "val"),
        report=lambda progress: signal.raise_signal(signal.SIGINT),
    )
    settings = ("--preset", "mpnet", "--threads", 1, "--steps", 1)
    done = cli("train", data, tmp_path, *settings, "--json")
    assert done.exit_code == 0, done.output
    assert json.loads(done.stdout)["validation_loss"] is None
    assert "validation_loss" not in cli("train", data, tmp_path, *settings).output


@pytest.mark.parametrize("preset", ["mpnet", "next-ks"])
def test_options_of_region_proposers_are_refused(cli, data, tmp_path, preset):
    done = cli("train", data, tmp_path, "--preset", preset, "--steps", 1, "--positive-weight", 2)
    assert done.exit_code == 2
    assert "--positive-weight" in done.output


def test_no_checkpoint_is_no_planner(cli, tmp_path):
    (tmp_path / "checkpoint.pt").write_bytes(b"nothing")
    done = cli("export", tmp_path / "checkpoint.pt", tmp_path / "weights.onnx")
    assert done.exit_code == 2
    assert "no usable checkpoint" in done.output
