from __future__ import annotations

import json

import pytest

pytest.importorskip("torch", reason="the export needs PyTorch")
pytest.importorskip("onnx", reason="the export needs onnx")
pytest.importorskip("onnxruntime", reason="the export is checked by ONNX Runtime")

import onnxruntime
import torch

from planformer.encoding import NetworkScale
from planformer.errors import InvalidWeights
from planformer.export import mpnet
from planformer.export.mpnet import DeployedMPNet, example_inputs, export_mpnet
from planformer.models.mpnet import MPNet, MPNetConfig
from planformer.models.storage import load_mpnet, save_planner
from planformer.weights import read_weights

# Large enough for some arrays to be stored in half precision.
CONFIG = MPNetConfig(channels=(4, 8, 8), grid=4, latent=16, widths=(64, 32, 16))


@pytest.fixture
def checkpoint(tmp_path):
    with torch.random.fork_rng():
        torch.manual_seed(0)
        network = MPNet(CONFIG)
    history = [{"step": 1, "validation_loss": 0.2}, {"step": 2, "validation_loss": 0.1}]
    save_planner(tmp_path / "a.pt", network, step=2, history=history, data={"seed": 1})
    return tmp_path / "a.pt"


def test_onnx_equals_pytorch_at_any_size(checkpoint, tmp_path):
    exported = export_mpnet(checkpoint, tmp_path / "new" / "a.onnx")
    assert exported.difference < 1e-5
    session = onnxruntime.InferenceSession(exported.weights)
    names = ["map", "latent", "current", "goal", "noise"]
    assert [value.name for value in session.get_inputs()] == names
    network, _ = load_mpnet(checkpoint)
    inputs = example_inputs(DeployedMPNet(network), 51, 77, seed=9)
    feed = {name: value.numpy() for name, value in zip(names, inputs, strict=True)}
    encoding, waypoint = session.run(["encoding", "waypoint"], feed)
    with torch.no_grad():
        assert torch.allclose(
            network.encode(inputs[0].float()), torch.from_numpy(encoding), atol=1e-2
        )
        assert torch.allclose(network(*inputs[1:]), torch.from_numpy(waypoint), atol=1e-2)


def test_half_precision_makes_the_file_smaller(checkpoint, tmp_path, monkeypatch):
    half = export_mpnet(checkpoint, tmp_path / "half.onnx").weights.stat().st_size
    monkeypatch.setattr(mpnet, "_LARGE", 10**9)
    full = export_mpnet(checkpoint, tmp_path / "full.onnx").weights.stat().st_size
    numbers = sum(p.numel() for p in MPNet(CONFIG).parameters())
    assert full - half > numbers


def test_the_card_describes_the_weights(checkpoint, tmp_path):
    exported = export_mpnet(checkpoint, tmp_path / "b.onnx", name="mpnet.test")
    card = json.loads(exported.card.read_text())
    assert read_weights(exported.weights).card == card
    assert (card["name"], card["robot"], card["planner"]) == ("mpnet.test", "point", "MPNet")
    assert MPNetConfig.from_dict(card["network"]) == CONFIG
    assert NetworkScale.from_dict(card["scale"]) == CONFIG.scale
    assert card["training"]["step"] == 2
    assert card["validation_loss"] == 0.1


def test_a_network_that_differs_is_not_written(checkpoint, tmp_path, monkeypatch):
    other, original = DeployedMPNet(MPNet(CONFIG)), mpnet.to_onnx
    monkeypatch.setattr(mpnet, "to_onnx", lambda deployed: original(other))
    with pytest.raises(InvalidWeights, match="differs"):
        export_mpnet(checkpoint, tmp_path / "a.onnx")
    assert [path.name for path in tmp_path.iterdir()] == ["a.pt"]


def test_bad_files_are_refused(checkpoint, tmp_path):
    with pytest.raises(InvalidWeights, match=r"\*\.onnx"):
        export_mpnet(checkpoint, tmp_path / "a.bin")
    with pytest.raises(InvalidWeights, match="no checkpoint"):
        export_mpnet(tmp_path / "missing.pt", tmp_path / "a.onnx")
