from __future__ import annotations

import math

import pytest

pytest.importorskip("torch", reason="training needs PyTorch")

import torch

from planformer.models import Proposal
from planformer.training import TrainConfig
from planformer.training.losses import balanced_cross_entropy, heading_loss, proposal_loss
from planformer.training.samples import Batch


def _labels():
    positive = torch.zeros(3, 1, 10, 10)
    positive[0, 0, :2] = 1  # 20 positives; none in the last problem
    positive[1, 0, 0, :3] = 1
    return positive


def test_balanced_loss_ignores_how_many_negatives_there_are():
    labels = _labels()
    logits = torch.where(labels > 0.5, 1.0, -2.0)
    own = [math.log1p(math.exp(-1.0)), math.log1p(math.exp(-2.0))]
    with torch.random.fork_rng():
        loss = balanced_cross_entropy(logits, labels)
    assert torch.isclose(loss, torch.tensor(2 * sum(own) / 2))


def test_balanced_loss_draws_negatives_at_random():
    labels = _labels()
    logits = torch.linspace(-3, 3, 300).reshape(3, 1, 10, 10)
    with torch.random.fork_rng():
        torch.manual_seed(0)
        assert balanced_cross_entropy(logits, labels) != balanced_cross_entropy(logits, labels)


def test_positive_weight_raises_the_price_of_misses_only():
    labels = _labels()
    batch = Batch(labels, labels, labels, torch.empty(3, 0, 10, 10))
    light, heavy = (TrainConfig(steps=1, positive_weight=w) for w in (1.0, 4.0))
    missing = Proposal(torch.full_like(labels, -5.0), None)
    false = Proposal(torch.where(labels > 0.5, 20.0, 5.0), None)
    assert proposal_loss(missing, batch, heavy) > 3 * proposal_loss(missing, batch, light)
    assert torch.isclose(proposal_loss(false, batch, heavy), proposal_loss(false, batch, light))


def test_heading_loss_is_zero_for_the_right_direction_and_two_for_the_opposite():
    target = torch.zeros(1, 2, 4, 4)
    target[0, :, 1, 1] = torch.tensor([0.6, 0.8])
    assert torch.isclose(heading_loss(5 * target, target), torch.tensor(0.0), atol=1e-6)
    assert torch.isclose(heading_loss(-target, target), torch.tensor(2.0))
    anywhere_else = target + (target == 0).all(1, keepdim=True).float()
    assert torch.isclose(heading_loss(anywhere_else, target), torch.tensor(0.0), atol=1e-6)


def test_heading_loss_without_labels_is_zero():
    assert heading_loss(torch.ones(1, 2, 3, 3), torch.zeros(1, 2, 3, 3)) == 0
