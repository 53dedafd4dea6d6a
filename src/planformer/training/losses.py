"""What a region proposal network should get right."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import torch
import torch.nn.functional as F
from torch import Tensor

from planformer.models.proposal import Proposal
from planformer.training.config import Recipe, TrainConfig
from planformer.training.samples import Batch

OFFSET_UNIT = 0.2
"""Error in metres of an anchor's offset that costs as much as a loss of 1 in its class."""

DeviceMean: TypeAlias = Callable[[Tensor], Tensor]
"""The mean of a number over the devices that share a batch. Losses divide by it so that their own
mean over the devices is the loss of the whole batch."""


def _of_one(value: Tensor) -> Tensor:
    """The mean over a single device."""
    return value


def proposal_loss(
    proposal: Proposal, batch: Batch, config: TrainConfig, *, device_mean: DeviceMean = _of_one
) -> Tensor:
    """Loss of a batch: the anchors' classes and, where predicted, the headings and the offsets.

    Args:
        proposal: The network's output.
        batch: The labels.
        config: Recipe and weights.
        device_mean: Where several devices share the batch, the mean over them.

    Returns:
        A scalar. The paper's loss of the classes is a mean over the problems, all others are means
        over the batch's anchors; those beyond their maps do not count.
    """
    logits = proposal.logits.float()
    if config.recipe is Recipe.PAPER:
        loss = balanced_cross_entropy(logits, batch.positive, batch.inside)
    else:
        loss = weighted_cross_entropy(logits, batch, config, device_mean=device_mean)
    if proposal.heading is not None:
        of_heading = cosine_loss if config.recipe is Recipe.PAPER else von_mises_loss
        loss = loss + of_heading(proposal.heading.float(), batch.heading, device_mean=device_mean)
    if proposal.offset is not None:
        offset = proposal.offset.float()
        loss = loss + offset_loss(offset, batch.offset, batch.positive, device_mean=device_mean)
    return loss


def weighted_cross_entropy(
    logits: Tensor, batch: Batch, config: TrainConfig, *, device_mean: DeviceMean = _of_one
) -> Tensor:
    """The compact recipe's loss: all anchors, the positive ones weighted up."""
    labels = batch.positive
    weight = torch.tensor(config.positive_weight, device=logits.device)
    loss = F.binary_cross_entropy_with_logits(logits, labels, pos_weight=weight, reduction="none")
    return _mean(loss, batch.inside, device_mean)


def balanced_cross_entropy(logits: Tensor, positive: Tensor, inside: Tensor) -> Tensor:
    """The paper's loss: all positive anchors and as many random negative ones.

    Args:
        logits: (B, 1, h, w).
        positive: (B, 1, h, w), 1 = positive.
        inside: (B, 1, h, w), 0 = beyond the map.

    Returns:
        The mean over problems of the mean cross-entropy over their chosen anchors. (The paper
        sums over the problems, which is all the same to Adam.)
    """
    labels, allowed = positive.flatten(1), inside.flatten(1) > 0.5
    is_positive = (labels > 0.5) & allowed
    count = is_positive.sum(dim=1, keepdim=True)
    draw = torch.rand_like(labels).masked_fill(is_positive | ~allowed, 2.0)
    rank = draw.argsort(dim=1).argsort(dim=1)  # the negatives in random order, then the others
    chosen = (((rank < count) & allowed) | is_positive).float()
    loss = F.binary_cross_entropy_with_logits(logits.flatten(1), labels, reduction="none")
    return ((loss * chosen).sum(dim=1) / chosen.sum(dim=1).clamp(min=1)).mean()


def imitation_loss(
    logits: Tensor, teacher: Tensor, inside: Tensor, *, device_mean: DeviceMean = _of_one
) -> Tensor:
    """How far a network's probabilities are from a teacher's: their cross-entropy.

    Hinton, Vinyals and Dean, Distilling the knowledge in a neural network, 2015, at temperature 1.

    Args:
        logits: (B, 1, h, w) of the network.
        teacher: (B, 1, h, w) logits of the teacher.
        inside: (B, 1, h, w), 0 = beyond the map.
        device_mean: As for `proposal_loss`.
    """
    targets = teacher.float().sigmoid()
    loss = F.binary_cross_entropy_with_logits(logits.float(), targets, reduction="none")
    return _mean(loss, inside, device_mean)


def cosine_loss(heading: Tensor, target: Tensor, *, device_mean: DeviceMean = _of_one) -> Tensor:
    """The paper's loss of headings: 1 - cos(angle between prediction and label).

    Args:
        heading: (B, 2, h, w), any length.
        target: (B, 2, h, w) mean direction of the path near each anchor, zero where it has none.
        device_mean: As for `proposal_loss`.

    Returns:
        The mean over the anchors that have a label.
    """
    loss = 1 - F.cosine_similarity(heading, target, dim=1)
    return _mean(loss, _has_heading(target), device_mean)


def von_mises_loss(heading: Tensor, target: Tensor, *, device_mean: DeviceMean = _of_one) -> Tensor:
    """Negative log-likelihood of the headings near an anchor under a von Mises distribution.

    The vector's direction is the distribution's mean and its length the concentration, so the
    network also says how sure it is.

    Args:
        heading: (B, 2, h, w).
        target: (B, 2, h, w) mean direction of the path near each anchor, zero where it has none;
            the shorter, the more the path turns there.
        device_mean: As for `proposal_loss`.

    Returns:
        The mean over the anchors that have a label.
    """
    concentration = heading.norm(dim=1)
    log_normaliser = torch.special.i0e(concentration).log() + concentration
    loss = log_normaliser - (heading * target).sum(dim=1)
    return _mean(loss, _has_heading(target), device_mean)


def _has_heading(target: Tensor) -> Tensor:
    """(B, h, w) float32, 1 at the anchors whose heading has a label."""
    return (target.square().sum(dim=1) > 0).float()


def offset_loss(
    offset: Tensor, target: Tensor, positive: Tensor, *, device_mean: DeviceMean = _of_one
) -> Tensor:
    """How far the anchors, moved by their offsets, are from the path.

    Args:
        offset: (B, 2, h, w) in metres.
        target: (B, 2, h, w) way from each anchor to the path in metres.
        positive: (B, 1, h, w), 1 at the anchors that have a target.
        device_mean: As for `proposal_loss`.

    Returns:
        The mean over these anchors of both components' absolute errors, in units of `OFFSET_UNIT`.
    """
    labelled = (positive >= 1.0).float()
    return _mean((offset - target).abs(), labelled, device_mean) / OFFSET_UNIT


def _mean(loss: Tensor, counted: Tensor, device_mean: DeviceMean) -> Tensor:
    """Mean over the anchors that count, where `counted` is 1, on all devices."""
    return (loss * counted).sum() / device_mean(counted.sum()).clamp(min=1)
