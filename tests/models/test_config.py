from __future__ import annotations

import json

import pytest

pytest.importorskip("torch", reason="the networks need PyTorch")

from planformer.errors import InvalidParameter
from planformer.models import PRESETS, CompactBody, MPTConfig, TransformerBody, preset


@pytest.mark.parametrize("name", PRESETS)
def test_survives_json(name):
    values = json.loads(json.dumps(preset(name).to_dict()))
    assert MPTConfig.from_dict(values) == preset(name)


def test_paper_preset_has_the_published_sizes():
    assert preset("paper").body == TransformerBody(
        width=512,
        layers=6,
        heads=3,
        key_width=512,
        value_width=256,
        feed_forward=1024,
        dropout=0.1,
        table=40,
    )
    scale = preset("paper").scale
    assert (scale.stride, scale.patch, scale.anchor_offset, scale.query) == (20, 32, 4, "square")


def test_unknown_preset_lists_the_valid_ones():
    with pytest.raises(InvalidParameter, match="paper-fixed-encoding"):
        preset("huge")


@pytest.mark.parametrize(
    "make",
    [
        lambda: MPTConfig(TransformerBody(), "wavefront"),
        lambda: MPTConfig(CompactBody(), "square"),
        lambda: TransformerBody(width=511),
        lambda: TransformerBody(dropout=1.0),
        lambda: TransformerBody(layers=0),
        lambda: CompactBody(width=90, heads=3),
        lambda: CompactBody(heads=-1),
        lambda: CompactBody(blocks=0),
        lambda: MPTConfig.from_dict({"body": {"architecture": "compact", "depth": 3}}),
        lambda: MPTConfig.from_dict({"body": {"architecture": "unet"}}),
        lambda: MPTConfig.from_dict({"body": {"architecture": "compact"}, "yaw": True}),
    ],
)
def test_refuses(make):
    with pytest.raises(InvalidParameter):
        make()
