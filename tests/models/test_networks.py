from __future__ import annotations

from dataclasses import replace

import pytest

pytest.importorskip("torch", reason="the networks need PyTorch")

import torch

from planformer.encoding import QueryKind
from planformer.models import (
    PRESETS,
    CompactBody,
    MPTConfig,
    TransformerBody,
    UNetBody,
    create_model,
    preset,
)

SHORT = TransformerBody(width=32, layers=2, key_width=16, value_width=16, feed_forward=32)


def _transformer(headings=False, **changes):
    return MPTConfig(replace(SHORT, **changes), QueryKind.SQUARE, headings)


def _inputs(config, height, width, batch=1):
    side = config.scale.query_stride
    generator = torch.Generator().manual_seed(0)
    occupancy = torch.randint(2, (batch, 1, height, width), generator=generator).float()
    shape = (batch, config.scale.query_channels, height // side, width // side)
    return occupancy, torch.randn(shape, generator=generator)


@pytest.fixture(autouse=True)
def _seed():
    with torch.random.fork_rng():
        torch.manual_seed(0)
        yield


@torch.no_grad()
def _evaluate(model, inputs):
    return model.eval()(*inputs)


def _count(model):
    return sum(parameter.numel() for parameter in model.parameters())


def test_parameter_counts():
    assert 19e6 < _count(create_model("paper")) < 22e6  # "about 20 M"
    assert 0.09e6 < _count(create_model("small")) < 0.12e6
    assert 0.25e6 < _count(create_model("dubins")) < 0.35e6
    assert _count(create_model("tiny")) < 0.1e6
    assert 3e6 < _count(create_model("unet")) < 5e6


@pytest.mark.parametrize("name", PRESETS)
def test_presets_make_the_anchors_of_their_scale(name):
    config = preset(name)
    side = 480 // config.scale.stride
    # A pixel's corner each, or a metre apart.
    assert side == (480 if name.startswith("unet") else 24)
    proposal = _evaluate(create_model(name), _inputs(config, 480, 480))
    assert proposal.logits.shape == (1, 1, side, side)
    assert (proposal.heading is not None) == config.headings
    assert (proposal.offset is not None) == config.offsets


@pytest.mark.parametrize("headings", [False, True])
@pytest.mark.parametrize("size", [(20, 20), (20, 60), (60, 40), (520, 500), (840, 20)])
@pytest.mark.parametrize(
    "make",
    [
        _transformer,
        lambda h: MPTConfig(headings=h),
        lambda h: MPTConfig(headings=h, offsets=True),
    ],
)
def test_any_multiple_of_the_stride(make, size, headings):
    config = make(headings)
    tokens = (size[0] // 20, size[1] // 20)
    logits, heading, offset = _evaluate(create_model(config), _inputs(config, *size, batch=2))
    assert logits.shape == (2, 1, *tokens)
    assert torch.isfinite(logits).all()
    assert heading is None if not headings else heading.shape == (2, 2, *tokens)
    assert offset is None if not config.offsets else offset.shape == (2, 2, *tokens)


@pytest.mark.parametrize("size", [(1, 1), (17, 40), (64, 31)])
def test_the_unet_takes_any_size(size):
    config = MPTConfig(UNetBody((4, 8, 8)), QueryKind.SQUARE)
    logits = _evaluate(create_model(config), _inputs(config, *size, batch=2)).logits
    assert logits.shape == (2, 1, *size)
    assert torch.isfinite(logits).all()


def test_the_unet_joins_its_resolutions():
    config = MPTConfig(UNetBody((4, 8, 8)), QueryKind.SQUARE)
    model = create_model(config).eval()
    occupancy, query = _inputs(config, 32, 32)
    query.requires_grad_()
    model(occupancy, query).logits[0, 0, 16, 16].backward()
    seen = query.grad[0, 0].nonzero()
    assert (seen.amax(dim=0) - seen.amin(dim=0) > 20).all()  # far more than convolutions of 3 x 3
    for parameter in model.parameters():
        assert parameter.grad is not None


def _positions(shifted):
    model = create_model(_transformer(shift_positions=shifted))
    return model.positions, torch.zeros(8, 32, 6, 7)


def test_shifted_encoding_differs_between_maps_in_training():
    positions, features = _positions(shifted=True)
    encoded = positions.train()(features)
    assert encoded.shape == (8, 32, 6, 7)
    assert any(not torch.equal(encoded[0], other) for other in encoded[1:])


def test_shifted_encoding_is_a_window_of_the_table():
    positions, features = _positions(shifted=True)
    table = positions.eval()(torch.zeros(1, 32, 40, 40))[0]
    windows = table.unfold(1, 6, 1).unfold(2, 7, 1)  # (d, 35, 34, 6, 7)
    for encoded in positions.train()(features):
        distance = (windows - encoded[:, None, None]).abs().amax(dim=(0, 3, 4))
        assert distance.min() < 1e-3


@pytest.mark.parametrize("shifted", [False, True])
def test_encoding_is_fixed_in_evaluation(shifted):
    positions, features = _positions(shifted)
    assert torch.equal(positions.eval()(features), positions(features))


def test_fixed_encoding_is_the_same_in_training():
    positions, features = _positions(shifted=False)
    assert torch.equal(positions.train()(features), positions.eval()(features))


def test_encoding_follows_the_papers_equations():
    positions, features = _positions(shifted=False)
    place, frequencies = 2 * 7 + 3, [10000 ** -(channel / 32) for channel in range(32)]
    angles = torch.tensor([place * frequency for frequency in frequencies])
    expected = torch.where(torch.arange(32) % 2 == 0, angles.sin(), angles.cos())
    assert torch.allclose(positions(features)[0, :, 2, 3], expected, atol=1e-5)


def test_wide_maps_give_each_token_its_own_encoding():
    positions, _ = _positions(shifted=True)
    encoded = positions.eval()(torch.zeros(1, 32, 3, 50))[0].flatten(1).T
    distance = torch.cdist(encoded, encoded) + torch.eye(150)
    assert distance.min() > 1e-3


def test_checkpointing_changes_no_gradient():
    gradients = []
    for checkpointing in (False, True):
        torch.manual_seed(0)
        config = _transformer(checkpointing=checkpointing)
        model = create_model(config).train()
        model(*_inputs(config, 60, 60)).logits.sum().backward()
        gradients.append(torch.cat([p.grad.flatten() for p in model.parameters()]))
    assert torch.allclose(*gradients, atol=1e-6)


def test_compact_attention_sees_the_whole_window():
    config = MPTConfig(CompactBody(width=48, stem=8, blocks=1, heads=3))
    model = create_model(config).eval()
    occupancy, query = _inputs(config, 480, 480)
    query.requires_grad_()
    model(occupancy, query).logits[0, 0, 0, 0].backward()
    assert (query.grad[0, :, -4:, -4:] != 0).any()


def test_compact_windows_do_not_depend_on_what_lies_beyond_the_map():
    """A map smaller than the window: the padding must get no attention."""
    config = MPTConfig(CompactBody(width=48, stem=8, blocks=1, heads=3, window=3))
    wide = MPTConfig(replace(config.body, window=24))
    inputs = _inputs(config, 60, 60)  # 3 x 3 tokens, exactly one small window
    model, other = create_model(config), create_model(wide)
    other.load_state_dict(model.state_dict())
    expected, actual = (_evaluate(m, inputs).logits for m in (model, other))
    assert torch.allclose(actual, expected, atol=1e-5)


def test_compact_is_translation_equivariant_inside_its_window():
    config = MPTConfig(CompactBody(width=48, stem=8, blocks=1, heads=3, window=6))
    model = create_model(config).eval()
    with torch.no_grad():
        attention = model.blocks[1]
        tokens = torch.randn(1, 48, 6, 6)
        rotated = [attention._rotate(torch.ones(1, 1, 36, 16))[0, 0].view(6, 6, 16)]
    scores = torch.einsum("abk,cdk->abcd", rotated[0], rotated[0])
    assert torch.allclose(scores[1:, 1:, 1:, 1:], scores[:-1, :-1, :-1, :-1], atol=1e-4)
    assert not torch.allclose(scores[0, 0], scores[0, 0, 0, 0])
    assert tokens.shape == attention(tokens).shape
