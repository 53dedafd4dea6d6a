"""What a region proposal network should get right."""

from __future__ import annotations

import torch
import torch.nn.functional as F
from torch import Tensor

from planformer.models.proposal import Proposal
from planformer.training.config import Recipe, TrainConfig
from planformer.training.samples import Batch

OFFSET_UNIT = 0.2
"""Error in metres of an anchor's offset that costs as much as a loss of 1 in its class."""


def proposal_loss(proposal: Proposal, batch: Batch, config: TrainConfig) -> Tensor:
    """Loss of a batch: the anchors' classes and, where predicted, the headings and the offsets.

    Args:
        proposal: The network's output.
        batch: The labels.
        config: Recipe and weights.

    Returns:
        A scalar, the mean over the problems; anchors beyond their maps do not count.
    """
    logits = proposal.logits.float()
    if config.recipe is Recipe.PAPER:
        loss = balanced_cross_entropy(logits, batch.positive, batch.inside)
    else:
        loss = weighted_cross_entropy(logits, batch, config)
    if proposal.heading is not None:
        of_heading = cosine_loss if config.recipe is Recipe.PAPER else von_mises_loss
        loss = loss + of_heading(proposal.heading.float(), batch.heading)
    if proposal.offset is not None:
        loss = loss + offset_loss(proposal.offset.float(), batch.offset, batch.positive)
    return loss


def weighted_cross_entropy(logits: Tensor, batch: Batch, config: TrainConfig) -> Tensor:
    """The compact recipe's loss: all anchors, the positive ones weighted up."""
    labels = batch.positive
    weight = torch.tensor(config.positive_weight, device=logits.device)
    loss = F.binary_cross_entropy_with_logits(logits, labels, pos_weight=weight, reduction="none")
    return _mean_inside(loss, batch.inside)


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


def imitation_loss(logits: Tensor, teacher: Tensor, inside: Tensor) -> Tensor:
    """How far a network's probabilities are from a teacher's: their cross-entropy.

    Hinton, Vinyals and Dean, Distilling the knowledge in a neural network, 2015, at temperature 1.

    Args:
        logits: (B, 1, h, w) of the network.
        teacher: (B, 1, h, w) logits of the teacher.
        inside: (B, 1, h, w), 0 = beyond the map.
    """
    targets = teacher.float().sigmoid()
    loss = F.binary_cross_entropy_with_logits(logits.float(), targets, reduction="none")
    return _mean_inside(loss, inside)


def _mean_inside(loss: Tensor, inside: Tensor) -> Tensor:
    return (loss * inside).sum() / inside.sum()


def cosine_loss(heading: Tensor, target: Tensor) -> Tensor:
    """The paper's loss of headings: 1 - cos(angle between prediction and label).

    Args:
        heading: (B, 2, h, w), any length.
        target: (B, 2, h, w) mean direction of the path near each anchor, zero where it has none.

    Returns:
        The mean over the anchors that have a label.
    """
    return _mean_labelled(1 - F.cosine_similarity(heading, target, dim=1), target)


def von_mises_loss(heading: Tensor, target: Tensor) -> Tensor:
    """Negative log-likelihood of the headings near an anchor under a von Mises distribution.

    The vector's direction is the distribution's mean and its length the concentration, so the
    network also says how sure it is.

    Args:
        heading: (B, 2, h, w).
        target: (B, 2, h, w) mean direction of the path near each anchor, zero where it has none;
            the shorter, the more the path turns there.

    Returns:
        The mean over the anchors that have a label.
    """
    concentration = heading.norm(dim=1)
    log_normaliser = torch.special.i0e(concentration).log() + concentration
    return _mean_labelled(log_normaliser - (heading * target).sum(dim=1), target)


def offset_loss(offset: Tensor, target: Tensor, positive: Tensor) -> Tensor:
    """How far the anchors, moved by their offsets, are from the path.

    Args:
        offset: (B, 2, h, w) in metres.
        target: (B, 2, h, w) way from each anchor to the path in metres.
        positive: (B, 1, h, w), 1 at the anchors that have a target.

    Returns:
        The mean over these anchors of both components' absolute errors, in units of `OFFSET_UNIT`.
    """
    labelled = (positive >= 1.0).float()
    error = ((offset - target).abs() * labelled).sum() / labelled.sum().clamp(min=1)
    return error / OFFSET_UNIT


def _mean_labelled(loss: Tensor, target: Tensor) -> Tensor:
    labelled = target.square().sum(dim=1) > 0
    return (loss * labelled).sum() / labelled.sum().clamp(min=1)
