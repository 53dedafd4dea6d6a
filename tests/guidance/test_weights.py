from __future__ import annotations

import json

import numpy as np
import pytest

import planformer as pf
from planformer.errors import InvalidWeights, UnknownGuide, WeightsMismatch
from planformer.guidance import load_network
from planformer.guidance.weights import weights_path
from planformer.weights import SHIPPED, read_weights


def test_shipped_weights_fit_their_cards():
    names = pf.guide_names()
    assert names[0] == "mpt"
    for name in names:
        weights = read_weights(weights_path(name))
        assert weights.card["accuracy"]["all"]["problems"] >= 500


def test_every_shipped_file_is_an_onnx_file_with_a_card():
    stems = {path.stem for path in SHIPPED.iterdir() if path.suffix in {".onnx", ".json"}}
    assert stems
    for stem in stems:
        assert (SHIPPED / f"{stem}.onnx").is_file()
        assert (SHIPPED / f"{stem}.json").is_file()


@pytest.mark.parametrize(
    "guide",
    [
        "nonsense",
        "",
        "../weights/mpt",
        "missing.onnx",
        "/etc/passwd",
        300 * "a",
        300 * "a" + ".onnx",
        "nul\0",
    ],
)
def test_an_unknown_guide_lists_the_valid_names(guide):
    with pytest.raises(UnknownGuide, match=r"valid: mpt, mpt-dubins, mpt-paper, "):
        load_network(guide)


def test_a_truncated_file_is_refused(make_weights):
    path = make_weights()
    path.write_bytes(path.read_bytes()[:-20])
    with pytest.raises(WeightsMismatch, match="sha256"):
        load_network(str(path))


@pytest.mark.parametrize(
    "change",
    [
        {"version": 99},
        {"scale": None},
        {"scale": {"resolution": -1.0}},
        {"scale": {"colour": 3}},
    ],
)
def test_a_damaged_card_is_refused(make_weights, change):
    path = make_weights()
    card = path.with_suffix(".json")
    card.write_text(json.dumps({**json.loads(card.read_text()), **change}))
    with pytest.raises(InvalidWeights, match=r"constant\.json"):
        load_network(str(path))


@pytest.mark.parametrize("content", ["", "{", "[1]", "null"])
def test_a_card_that_is_no_card_is_refused(make_weights, content):
    path = make_weights()
    path.with_suffix(".json").write_text(content)
    with pytest.raises(InvalidWeights):
        load_network(str(path))


def test_weights_without_a_card_are_refused(make_weights):
    path = make_weights()
    path.with_suffix(".json").unlink()
    with pytest.raises(InvalidWeights, match="card"):
        load_network(str(path))


def test_a_file_that_is_no_network_is_refused(make_weights, tmp_path):
    import hashlib

    path = make_weights()
    path.write_bytes(b"not an onnx file")
    card = path.with_suffix(".json")
    digest = hashlib.sha256(path.read_bytes()).hexdigest()
    card.write_text(json.dumps({**json.loads(card.read_text()), "sha256": digest}))
    with pytest.raises(InvalidWeights, match="ONNX Runtime"):
        load_network(str(path))


def test_a_replaced_file_is_loaded_again(make_weights, room):
    path = make_weights(0.25)
    first = load_network(str(path)).predict(room).probability
    make_weights(0.75)
    second = load_network(str(path)).predict(room).probability
    np.testing.assert_allclose([first.max(), second.max()], [0.25, 0.75])


def test_a_file_whose_card_has_changed_is_loaded_again(make_weights):
    path = make_weights()
    assert load_network(str(path)).weights.card.get("note") is None
    card = path.with_suffix(".json")
    card.write_text(json.dumps({**json.loads(card.read_text()), "note": "corrected"}))
    assert load_network(str(path)).weights.card["note"] == "corrected"
