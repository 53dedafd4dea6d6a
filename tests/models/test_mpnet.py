from __future__ import annotations

import pytest

pytest.importorskip("torch", reason="the networks need PyTorch")

import torch

from planformer.errors import InvalidParameter, InvalidWeights
from planformer.models import MPTConfig, create_model, save_checkpoint
from planformer.models.mpnet import MPNet, MPNetConfig, _area_pooled
from planformer.models.storage import load_mpnet, save_planner

SMALL = MPNetConfig(channels=(2, 3, 4), grid=3, latent=5, widths=(8, 7, 6))


@pytest.fixture
def network():
    with torch.random.fork_rng():
        torch.manual_seed(0)
        return MPNet(SMALL)


def test_the_published_widths_are_the_default():
    network = MPNet(MPNetConfig())
    widths = [layer.out_features for layer in (*network.hidden, network.output)]
    assert widths == [1280, 1024, 896, 768, 512, 384, 256, 256, 128, 64, 32, 2]
    assert network.config.dropout == 0.5


@pytest.mark.parametrize("size", [(480, 480), (37, 91), (1, 1), (2, 300)])
def test_any_map_size(network, size):
    latent = network.encode(torch.zeros(2, 1, *size))
    assert latent.shape == (2, 5)
    assert latent.isfinite().all()


@pytest.mark.parametrize("size", [(12, 6), (7, 5), (1, 2)])
def test_pooled_means_are_those_of_equal_areas(size):
    """Each pixel cut into as many as there are cells gives areas of whole pixels."""
    cells = 3
    features = torch.rand(2, 4, *size, generator=torch.Generator().manual_seed(1))
    fine = features.repeat_interleave(cells, dim=2).repeat_interleave(cells, dim=3)
    expected = torch.nn.functional.adaptive_avg_pool2d(fine, cells)
    assert torch.allclose(_area_pooled(features, cells), expected, atol=1e-6)


def test_the_noise_alone_decides_what_is_dropped(network):
    states = torch.zeros(1, 5), torch.ones(1, 2), torch.ones(1, 2)
    noise = torch.rand(1, SMALL.units, generator=torch.Generator().manual_seed(0))
    first = network.train()(*states, noise)
    assert torch.equal(first, network.eval()(*states, noise))
    assert not torch.equal(first, network(*states, 1 - noise))
    assert SMALL.units == 8 + 7


def test_all_units_dropped_leaves_the_last_layers_biases(network):
    states = torch.rand(2, 5), torch.ones(2, 2), torch.ones(2, 2)
    first, second = network(*states, torch.zeros(2, SMALL.units))
    assert torch.equal(first, second)


def test_waypoints_stay_on_the_map(network):
    states = 100 * torch.randn(50, 5), torch.ones(50, 2), -torch.ones(50, 2)
    assert network(*states, torch.rand(50, SMALL.units)).abs().max() <= 1


def test_a_configuration_survives_its_dictionary():
    assert MPNetConfig.from_dict(SMALL.to_dict()) == SMALL
    assert SMALL.to_dict()["architecture"] == "mpnet"


@pytest.mark.parametrize(
    "change",
    [
        {"channels": (8, 16)},
        {"widths": (32,)},
        {"widths": (32, 0)},
        {"grid": 0},
        {"dropout": 1.0},
        {"resolution": float("nan")},
        {"colour": 3},
        {"architecture": "unet"},
    ],
)
def test_impossible_configurations(change):
    with pytest.raises(InvalidParameter):
        MPNetConfig.from_dict({**SMALL.to_dict(), **change})


def test_a_checkpoint_holds_the_network_and_its_state(network, tmp_path):
    save_planner(tmp_path / "new" / "a.pt", network, step=3)
    loaded, stored = load_mpnet(tmp_path / "new" / "a.pt")
    assert stored == {"step": 3}
    assert loaded.config == SMALL
    for name, value in network.state_dict().items():
        assert torch.equal(value, loaded.state_dict()[name])


def test_other_files_are_refused(tmp_path):
    with pytest.raises(InvalidWeights, match="no checkpoint at"):
        load_mpnet(tmp_path / "missing.pt")
    (tmp_path / "damaged.pt").write_bytes(b"PK\x03\x04")
    with pytest.raises(InvalidWeights):
        load_mpnet(tmp_path / "damaged.pt")
    save_checkpoint(tmp_path / "mpt.pt", MPTConfig(), create_model("tiny"))
    with pytest.raises(InvalidWeights):
        load_mpnet(tmp_path / "mpt.pt")
