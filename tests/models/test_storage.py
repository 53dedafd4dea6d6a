from __future__ import annotations

import pytest

pytest.importorskip("torch", reason="the networks need PyTorch")

import torch

from planformer.errors import InvalidWeights
from planformer.models import (
    create_model,
    load_checkpoint,
    preset,
    save_checkpoint,
)


def test_a_checkpoint_comes_back(tmp_path):
    model = create_model("tiny")
    save_checkpoint(tmp_path / "a.pt", preset("tiny"), model, step=7)
    config, loaded, rest = load_checkpoint(tmp_path / "a.pt")
    assert config == preset("tiny")
    assert rest == {"step": 7}
    weights = loaded.state_dict()
    assert all(torch.equal(value, weights[key]) for key, value in model.state_dict().items())


@pytest.mark.parametrize("damage", ["missing", "truncated", "garbage", "other"])
def test_refuses_what_is_no_checkpoint(tmp_path, damage):
    path = tmp_path / "a.pt"
    save_checkpoint(path, preset("tiny"), create_model("tiny"))
    if damage == "missing":
        path.unlink()
    elif damage == "truncated":
        path.write_bytes(path.read_bytes()[:1000])
    elif damage == "garbage":
        path.write_bytes(b"not a checkpoint")
    else:
        torch.save([1, 2], path)
    with pytest.raises(InvalidWeights):
        load_checkpoint(path)
