"""What a region proposal network should get right."""

from __future__ import annotations

import torch
import torch.nn.functional as F
from torch import Tensor

from planformer.models.proposal import Proposal
from planformer.training.config import Recipe, TrainConfig
from planformer.training.samples import Batch


def proposal_loss(proposal: Proposal, batch: Batch, config: TrainConfig) -> Tensor:
    """Loss of a batch: the anchors' classes and, where predicted, the headings.

    Args:
        proposal: The network's output.
        batch: The labels.
        config: Recipe and weights.

    Returns:
        A scalar.
    """
    logits = proposal.logits.float()
    if config.recipe is Recipe.PAPER:
        loss = balanced_cross_entropy(logits, batch.positive)
    else:
        weight = torch.tensor(config.positive_weight, device=logits.device)
        loss = F.binary_cross_entropy_with_logits(logits, batch.positive, pos_weight=weight)
    if proposal.heading is None:
        return loss
    return loss + heading_loss(proposal.heading.float(), batch.heading)


def balanced_cross_entropy(logits: Tensor, positive: Tensor) -> Tensor:
    """The paper's loss: all positive anchors and as many random negative ones.

    Args:
        logits: (B, 1, h, w).
        positive: (B, 1, h, w), 1 = positive.

    Returns:
        The sum over problems of the mean cross-entropy over their chosen anchors.
    """
    labels = positive.flatten(1)
    count = labels.sum(dim=1, keepdim=True)
    draw = torch.rand_like(labels).masked_fill(labels > 0.5, 2.0)
    rank = draw.argsort(dim=1).argsort(dim=1)  # the negatives in random order, then the positives
    chosen = ((rank < count) | (labels > 0.5)).float()
    loss = F.binary_cross_entropy_with_logits(logits.flatten(1), labels, reduction="none")
    return ((loss * chosen).sum(dim=1) / chosen.sum(dim=1).clamp(min=1)).sum()


def heading_loss(heading: Tensor, target: Tensor) -> Tensor:
    """Mean of 1 - cos(angle between prediction and label) over the anchors that have a label.

    Args:
        heading: (B, 2, h, w), any length.
        target: (B, 2, h, w) unit vectors, zero where there is no label.
    """
    labelled = target.square().sum(dim=1) > 0.5
    cosine = F.cosine_similarity(heading, target, dim=1)
    return ((1 - cosine) * labelled).sum() / labelled.sum().clamp(min=1)
