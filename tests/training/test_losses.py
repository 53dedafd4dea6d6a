from __future__ import annotations

import math

import numpy as np
import pytest
from scipy import stats

pytest.importorskip("torch", reason="training needs PyTorch")

import torch
import torch.nn.functional as F

from planformer.models import Proposal
from planformer.training import TrainConfig
from planformer.training.losses import (
    OFFSET_UNIT,
    balanced_cross_entropy,
    cosine_loss,
    imitation_loss,
    offset_loss,
    proposal_loss,
    von_mises_loss,
)
from planformer.training.samples import Batch


def _labels():
    positive = torch.zeros(3, 1, 10, 10)
    positive[0, 0, :2] = 1  # 20 positives; none in the last problem
    positive[1, 0, 0, :3] = 1
    return positive


def _batch(labels):
    nothing = torch.empty(3, 0, 10, 10)
    return Batch(labels, labels, labels, nothing, nothing, torch.ones_like(labels))


def test_balanced_loss_ignores_how_many_negatives_there_are():
    labels = _labels()
    logits = torch.where(labels > 0.5, 1.0, -2.0)
    own = [math.log1p(math.exp(-1.0)), math.log1p(math.exp(-2.0))]
    with torch.random.fork_rng():
        loss = balanced_cross_entropy(logits, labels, torch.ones_like(labels))
    assert torch.isclose(loss, torch.tensor(2 * sum(own) / 2 / 3))


def test_balanced_loss_draws_negatives_at_random():
    labels = _labels()
    logits = torch.linspace(-3, 3, 300).reshape(3, 1, 10, 10)
    with torch.random.fork_rng():
        torch.manual_seed(0)
        losses = {
            float(balanced_cross_entropy(logits, labels, torch.ones_like(labels))) for _ in "abc"
        }
    assert len(losses) == 3


@pytest.mark.parametrize("recipe", ["compact", "paper"])
def test_anchors_beyond_the_map_count_for_nothing(recipe):
    config = TrainConfig(steps=1, recipe=recipe)
    labels = _labels()
    logits = torch.linspace(-3, 3, 300).reshape(3, 1, 10, 10)
    vectors = torch.zeros(3, 2, 10, 10)
    alone = _batch(labels)
    margin = (0, 4, 0, 7)
    padded = Batch(
        *(
            F.pad(tensor, margin)
            for tensor in (labels, labels, labels, vectors, vectors, alone.inside)
        )
    )
    losses = []
    for filler in (-9.0, 0.0, 9.0):
        with torch.random.fork_rng():
            torch.manual_seed(0)
            proposal = Proposal(F.pad(logits, margin, value=filler), None)
            losses.append(float(proposal_loss(proposal, padded, config)))
    assert len(set(losses)) == 1
    if recipe == "compact":  # the paper's draws other negatives
        assert losses[0] == pytest.approx(
            float(proposal_loss(Proposal(logits, None), alone, config))
        )


def test_offsets_count_only_where_there_is_a_path():
    positive = _labels()
    target = torch.randn(3, 2, 10, 10, generator=torch.Generator().manual_seed(0))
    assert offset_loss(target, target, positive) == 0
    elsewhere = target + (1 - positive)
    assert offset_loss(elsewhere, target, positive) == 0
    aside = target + torch.tensor([0.1, -0.3]).reshape(1, 2, 1, 1)
    assert offset_loss(aside, target, positive) == pytest.approx(0.4 / OFFSET_UNIT)
    assert offset_loss(aside, target, torch.zeros_like(positive)) == 0


def test_a_network_with_offsets_is_punished_for_wrong_ones():
    labels = _labels()
    offset = torch.zeros(3, 2, 10, 10)
    batch = _batch(labels)._replace(offset=offset)
    right, wrong = (Proposal(labels, None, offset + error) for error in (0.0, 0.5))
    config = TrainConfig(steps=1)
    difference = proposal_loss(wrong, batch, config) - proposal_loss(right, batch, config)
    assert float(difference) == pytest.approx(1.0 / OFFSET_UNIT)


def test_the_losses_of_devices_that_share_a_batch_have_its_loss_as_their_mean():
    """Each of three has one problem: with 20, with 3 and without positive anchors."""
    labels, config = _labels(), TrainConfig(steps=1)
    vectors = torch.randn(4, 3, 2, 10, 10, generator=torch.Generator().manual_seed(0))
    inside = torch.ones_like(labels)
    inside[2, :, 5:] = 0
    batch = _batch(labels)._replace(heading=vectors[0] * labels, offset=vectors[1], inside=inside)
    proposal = Proposal(vectors[2, :, :1], vectors[3], vectors[2])
    shares = [
        [type(whole)(*(tensor[i : i + 1] for tensor in whole)) for whole in (proposal, batch)]
        for i in range(3)
    ]

    def counts(share):
        """What a device divides by on its own."""
        noted = []

        def note(own):
            noted.append(own)
            return own

        proposal_loss(*share, config, device_mean=note)
        return noted

    means = [sum(of_all) / 3 for of_all in zip(*map(counts, shares), strict=True)]

    def loss(share):
        of_all = iter(means)
        return float(proposal_loss(*share, config, device_mean=lambda own: next(of_all)))

    whole = float(proposal_loss(proposal, batch, config))
    assert np.mean([loss(share) for share in shares]) == pytest.approx(whole, rel=1e-5)


def test_imitation_is_best_where_pupil_and_teacher_agree():
    teacher = torch.linspace(-3, 3, 300).reshape(3, 1, 10, 10)
    inside = torch.ones_like(teacher)
    pupil = teacher.clone().requires_grad_()
    imitation_loss(pupil, teacher, inside).backward()
    assert torch.allclose(pupil.grad, torch.zeros(()), atol=1e-7)
    assert imitation_loss(teacher + 1, teacher, inside) > imitation_loss(teacher, teacher, inside)


def test_positive_weight_raises_the_price_of_misses_only():
    labels = _labels()
    batch = _batch(labels)
    light, heavy = (TrainConfig(steps=1, positive_weight=w) for w in (1.0, 4.0))
    missing = Proposal(torch.full_like(labels, -5.0), None)
    false = Proposal(torch.where(labels > 0.5, 20.0, 5.0), None)
    assert proposal_loss(missing, batch, heavy) > 3 * proposal_loss(missing, batch, light)
    assert torch.isclose(proposal_loss(false, batch, heavy), proposal_loss(false, batch, light))


def test_cosine_loss_is_zero_for_the_right_direction_and_two_for_the_opposite():
    target = torch.zeros(1, 2, 4, 4)
    target[0, :, 1, 1] = torch.tensor([0.6, 0.8])
    assert torch.isclose(cosine_loss(5 * target, target), torch.tensor(0.0), atol=1e-6)
    assert torch.isclose(cosine_loss(-target, target), torch.tensor(2.0))
    anywhere_else = target + (target == 0).all(1, keepdim=True).float()
    assert torch.isclose(cosine_loss(anywhere_else, target), torch.tensor(0.0), atol=1e-6)


def test_von_mises_loss_is_the_likelihood_of_the_headings_near_an_anchor():
    angles = np.random.default_rng(1).normal(0.7, 0.4, 50)
    target = torch.tensor([np.cos(angles).mean(), np.sin(angles).mean()]).reshape(1, 2, 1, 1)
    mean, concentration = 0.5, 3.0
    heading = concentration * torch.tensor([np.cos(mean), np.sin(mean)]).reshape(1, 2, 1, 1)
    expected = -stats.vonmises(concentration, loc=mean).logpdf(angles).mean() - np.log(2 * np.pi)
    assert float(von_mises_loss(heading, target)) == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize("loss", [cosine_loss, von_mises_loss])
def test_headings_without_labels_cost_nothing(loss):
    assert loss(torch.ones(1, 2, 3, 3), torch.zeros(1, 2, 3, 3)) == 0
