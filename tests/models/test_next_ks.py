from __future__ import annotations

import pytest

pytest.importorskip("torch", reason="the networks need PyTorch")

import torch

from planformer.errors import InvalidParameter, InvalidWeights
from planformer.models.next_ks import NextConfig, NextNetwork
from planformer.models.storage import load_next, save_planner

SMALL = NextConfig(side=8, depth=2, features=4, iterations=6)


@pytest.fixture
def network():
    torch.manual_seed(0)
    return NextNetwork(SMALL).eval()


def _inputs(count=5, maps=2, side=SMALL.side):
    generator = torch.Generator().manual_seed(1)
    free = torch.rand((maps, side, side), generator=generator)
    goal = 2 * torch.rand((maps, 2), generator=generator) - 1
    states = 2 * torch.rand((maps, count, 2), generator=generator) - 1
    return free, goal, states


@pytest.mark.parametrize("name", ["side", "depth", "features", "iterations"])
def test_sizes_are_checked(name):
    with pytest.raises(InvalidParameter, match=name):
        NextConfig(**{name: 0})


def test_a_configuration_survives_json():
    assert NextConfig.from_dict(SMALL.to_dict()) == SMALL
    with pytest.raises(InvalidParameter, match="colour"):
        NextConfig.from_dict({**SMALL.to_dict(), "colour": 1})
    with pytest.raises(InvalidParameter, match="architecture"):
        NextConfig.from_dict({**SMALL.to_dict(), "architecture": "unet"})


def test_attention_sums_to_one_and_starts_local(network):
    _, _, states = _inputs(count=50)
    with torch.no_grad():
        cells, depth = network.attention(states, SMALL.side)
    assert cells.shape == (2, 50, SMALL.side**2)
    assert depth.shape == (2, 50, SMALL.depth)
    torch.testing.assert_close(cells.sum(-1), torch.ones(2, 50))
    torch.testing.assert_close(depth.sum(-1), torch.ones(2, 50))
    at = ((states + 1) * SMALL.side / 2).floor().long()
    rows, columns = cells.argmax(-1) // SMALL.side, cells.argmax(-1) % SMALL.side
    assert (rows - at[..., 1]).abs().max() <= 1
    assert (columns - at[..., 0]).abs().max() <= 1


def test_states_do_not_depend_on_each_other(network):
    free, goal, states = _inputs()
    with torch.no_grad():
        context = network.plan(free, goal)
        mean, value = network.evaluate(context, states)
        one_mean, one_value = network.evaluate(context[1:], states[1:, 2:3])
    assert mean.shape == (2, 5, 2)
    assert value.shape == (2, 5)
    torch.testing.assert_close(mean[1:, 2:3], one_mean)
    torch.testing.assert_close(value[1:, 2:3], one_value)


def test_the_goal_is_known_as_far_away_as_there_are_iterations():
    torch.manual_seed(0)
    for iterations, reaches in ((1, False), (12, True)):
        network = NextNetwork(NextConfig(side=12, iterations=iterations)).eval()
        free = torch.ones(1, 12, 12)
        with torch.no_grad():
            contexts = [network.plan(free, torch.tensor([[x, -0.9]])) for x in (-0.9, -0.5)]
        change = (contexts[0] - contexts[1])[..., 0, 8].abs().max()
        assert bool(change > 1e-6) is reaches


def test_map_goal_and_state_matter_in_a_fresh_network(network):
    free, goal, states = _inputs(count=1, maps=1)
    with torch.no_grad():
        value = network.evaluate(network.plan(free, goal), states)[1]
        for other in ((1 - free, goal, states), (free, -goal, states), (free, goal, -states)):
            changed = network.evaluate(network.plan(*other[:2]), other[2])[1]
            assert abs(float(changed - value)) > 1e-3


def test_a_network_survives_storage(network, tmp_path):
    save_planner(tmp_path / "sub" / "next.pt", network, step=3)
    loaded, state = load_next(tmp_path / "sub" / "next.pt")
    assert (loaded.config, state) == (SMALL, {"step": 3})
    for ours, theirs in zip(loaded.parameters(), network.parameters(), strict=True):
        assert torch.equal(ours, theirs)


@pytest.mark.parametrize("content", [None, b"", b"PK\x03\x04 no checkpoint"])
def test_bad_files_are_refused(tmp_path, content):
    path = tmp_path / "next.pt"
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(InvalidWeights, match="checkpoint"):
        load_next(path)


def test_a_checkpoint_of_another_network_is_refused(tmp_path):
    torch.save({"config": {"architecture": "mpnet"}, "model": {}}, tmp_path / "other.pt")
    with pytest.raises(InvalidWeights, match="architecture"):
        load_next(tmp_path / "other.pt")
