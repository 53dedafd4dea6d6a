from __future__ import annotations

import hashlib
import json

import numpy as np
import pytest

pytest.importorskip("torch", reason="the export needs PyTorch")
pytest.importorskip("onnx", reason="the export needs onnx")
pytest.importorskip("onnxruntime", reason="the export is checked by ONNX Runtime")

import onnxruntime
import torch

import planformer as pf
from planformer.encoding import NetworkScale, QueryKind
from planformer.errors import InvalidParameter, InvalidWeights
from planformer.export import export, onnx
from planformer.models import (
    CompactBody,
    MPTConfig,
    TransformerBody,
    UNetBody,
    create_model,
    preset,
    save_checkpoint,
)

COMPACT = CompactBody(width=24, stem=8, blocks=1, heads=2)
PAPER = TransformerBody(width=32, layers=1, key_width=16, value_width=16, feed_forward=32)


def _checkpoint(path, config):
    with torch.random.fork_rng():
        torch.manual_seed(0)
        model = create_model(config)
    history = [
        {"step": step, "seconds": 1.0, "kind": "forest", "connected": connected}
        for step, connected in ((1, 0.2), (2, 0.9))
    ]
    save_checkpoint(path, config, model, step=2, history=history, data={"seed": 1})
    return path


@pytest.mark.parametrize("headings", [False, True])
@pytest.mark.parametrize(("body", "offsets"), [(COMPACT, False), (COMPACT, True), (PAPER, False)])
def test_onnx_equals_pytorch_at_many_sizes(tmp_path, body, offsets, headings):
    query = QueryKind.SQUARE if body is PAPER else QueryKind.WAVEFRONT
    checkpoint = _checkpoint(tmp_path / "a.pt", MPTConfig(body, query, headings, offsets))
    exported = export(checkpoint, tmp_path / "a.onnx")
    assert exported.difference < 1e-4
    session = onnxruntime.InferenceSession(exported.weights)
    names = ["probability", *["heading"] * headings, *["offset"] * offsets]
    assert [output.name for output in session.get_outputs()] == names
    assert {i.name: i.type for i in session.get_inputs()} == {
        "map": "tensor(uint8)",
        "query": "tensor(float)",
    }


def test_a_unet_proposes_pixels(tmp_path):
    config = MPTConfig(UNetBody((4, 8, 8)), QueryKind.SQUARE)
    exported = export(_checkpoint(tmp_path / "a.pt", config), tmp_path / "a.onnx")
    assert exported.difference < 1e-4
    grid = pf.OccupancyGrid(np.zeros((50, 70), bool), 0.05)
    ends = (0.5, 0.5), (3.0, 2.0)
    region = pf.propose_region(grid, pf.PointRobot(0.1), *ends, guide=str(exported.weights))
    assert region.probability.shape == (50, 70)
    assert region.connected
    result = pf.plan(
        grid, pf.PointRobot(0.1), *ends, guide=str(exported.weights), max_vertices=500, seed=1
    )
    assert result.solved


def test_the_papers_network_is_equally_sure_of_all_headings(tmp_path):
    config = MPTConfig(PAPER, QueryKind.SQUARE, headings=True)
    exported = export(_checkpoint(tmp_path / "a.pt", config), tmp_path / "a.onnx")
    session = onnxruntime.InferenceSession(exported.weights)
    inputs = {
        "map": np.zeros((1, 1, 60, 100), np.uint8),
        "query": np.ones((1, config.scale.query_channels, 60, 100), np.float32),
    }
    probability, heading = session.run(None, inputs)
    assert probability.shape == (1, 1, 3, 5)
    assert ((probability >= 0) & (probability <= 1)).all()
    assert np.allclose(np.hypot(*heading[0]), 8, atol=1e-3)


def test_the_card_describes_the_weights(tmp_path):
    exported = export(
        _checkpoint(tmp_path / "a.pt", preset("tiny")), tmp_path / "b.onnx", name="mpt_tiny.test"
    )
    card = json.loads(exported.card.read_text())
    assert exported.card == tmp_path / "b.json"
    assert card["sha256"] == hashlib.sha256(exported.weights.read_bytes()).hexdigest()
    assert (card["name"], card["robot"], card["preset"]) == ("mpt_tiny.test", "point", "tiny")
    assert NetworkScale.from_dict(card["scale"]) == preset("tiny").scale
    assert MPTConfig.from_dict(card["network"]) == preset("tiny")
    assert card["accuracy"] == {"forest": {"connected": 0.9}}  # the last validation
    assert card["training"]["step"] == 2


def test_a_network_that_differs_is_not_written(tmp_path, monkeypatch):
    checkpoint = _checkpoint(tmp_path / "a.pt", MPTConfig(COMPACT))
    other = onnx.DeployedProposer(create_model(MPTConfig(COMPACT))).eval()
    original = onnx.to_onnx
    monkeypatch.setattr(onnx, "to_onnx", lambda deployed, scale: original(other, scale))
    with pytest.raises(InvalidWeights, match="differs"):
        export(checkpoint, tmp_path / "a.onnx")
    assert [path.name for path in tmp_path.iterdir()] == ["a.pt"]


def test_weights_are_not_replaced_without_their_card(tmp_path):
    checkpoint = _checkpoint(tmp_path / "a.pt", MPTConfig(COMPACT))
    (tmp_path / "b.onnx").write_bytes(b"old")
    (tmp_path / "b.json").mkdir()
    with pytest.raises(InvalidParameter, match=r"b\.json: cannot be written"):
        export(checkpoint, tmp_path / "b.onnx")
    assert (tmp_path / "b.onnx").read_bytes() == b"old"


def test_refuses_another_suffix(tmp_path):
    with pytest.raises(InvalidWeights):
        export(_checkpoint(tmp_path / "a.pt", MPTConfig(COMPACT)), tmp_path / "a.bin")


def test_refuses_a_missing_checkpoint(tmp_path):
    with pytest.raises(InvalidWeights):
        export(tmp_path / "missing.pt", tmp_path / "a.onnx")
