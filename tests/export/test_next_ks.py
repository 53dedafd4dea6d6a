from __future__ import annotations

import json

import pytest

pytest.importorskip("torch", reason="export needs PyTorch")
pytest.importorskip("onnx", reason="export needs onnx")

import torch

from planformer.baselines.next_network import load_next
from planformer.errors import InvalidWeights
from planformer.export.next_ks import DeployedNext, example_inputs, export_next
from planformer.export.onnx import TOLERANCE
from planformer.models.next_ks import NextConfig, NextNetwork
from planformer.models.storage import save_planner

CONFIG = NextConfig(side=9, depth=2, features=4, iterations=3)


@pytest.fixture(scope="module")
def network():
    torch.manual_seed(0)
    return NextNetwork(CONFIG).eval()


@pytest.fixture(scope="module")
def checkpoint(network, tmp_path_factory):
    path = tmp_path_factory.mktemp("next") / "checkpoint.pt"
    save_planner(path, network, step=7, history=[{"loss": 1.0, "step_error": 0.5}])
    return path


def test_onnx_is_torch_one_stage_at_a_time(network, checkpoint, tmp_path):
    exported = export_next(checkpoint, tmp_path / "sub" / "next.onnx")
    assert exported.difference <= TOLERANCE
    evaluator = load_next(exported.weights)
    assert evaluator.side == CONFIG.side
    for seed, count in enumerate((1, 7)):
        free, goal, _, states = example_inputs(DeployedNext(network), count, seed=seed)
        with torch.no_grad():
            expected = network.plan(free, goal)
            mean, value = network.evaluate(expected, states)
        context = evaluator.plan(free[0].numpy(), goal[0].numpy())
        torch.testing.assert_close(torch.from_numpy(context), expected, atol=1e-4, rtol=1e-4)
        ours = evaluator.evaluate(context, states[0].numpy())
        torch.testing.assert_close(torch.from_numpy(ours[0]).float(), mean[0], atol=1e-4, rtol=1e-4)
        torch.testing.assert_close(
            torch.from_numpy(ours[1]).float(), value[0], atol=1e-4, rtol=1e-4
        )


def test_the_card_says_what_the_weights_are(checkpoint, tmp_path):
    exported = export_next(checkpoint, tmp_path / "next.onnx", name="next.test")
    card = json.loads(exported.card.read_text())
    assert (card["name"], card["planner"], card["robot"]) == ("next.test", "NEXT-KS", "point")
    assert NextConfig.from_dict(card["network"]) == CONFIG
    assert card["training"]["step"] == 7
    assert card["validation"]["step_error"] == 0.5


def test_nothing_is_written_for_a_bad_checkpoint(network, tmp_path):
    save_planner(tmp_path / "nan.pt", network)
    content = torch.load(tmp_path / "nan.pt")
    content["model"]["head.0.bias"] += float("nan")
    torch.save(content, tmp_path / "nan.pt")
    (tmp_path / "broken.pt").write_bytes(b"broken")
    for name in ("nan", "broken", "missing"):
        with pytest.raises(InvalidWeights):
            export_next(tmp_path / f"{name}.pt", tmp_path / "out" / "next.onnx")
    assert not (tmp_path / "out").exists()


def test_the_file_must_be_named_onnx(checkpoint, tmp_path):
    with pytest.raises(InvalidWeights, match=r"\*\.onnx"):
        export_next(checkpoint, tmp_path / "next.bin")
