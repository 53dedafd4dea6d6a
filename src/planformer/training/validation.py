"""How good a network's regions are."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import torch
from numpy.typing import NDArray
from torch import nn

from planformer.encoding import NetworkScale, network_map, region_mask
from planformer.training.augmentation import Example
from planformer.training.config import TrainConfig
from planformer.training.connectivity import connected
from planformer.training.losses import proposal_loss
from planformer.training.samples import encode_examples
from planformer.training.sources import PathSource, load_example

THRESHOLD = 0.5
"""Probability from which an anchor belongs to the region, as in the paper."""

Metrics = dict[str, float]


@torch.no_grad()
def validate(
    model: nn.Module, source: PathSource, scale: NetworkScale, config: TrainConfig
) -> dict[str, Metrics]:
    """Measure a network on problems that are spread evenly over a data set.

    Args:
        model: The network; its mode is left as it was.
        source: Problems on maps that the network has not seen.
        scale: The network's scale.
        config: Number of problems, batch size and loss.

    Returns:
        For each kind of map and for "all": "problems"; "loss"; "precision" and "recall" of the
        anchors; "connected", the share of problems whose start and goal are joined inside region
        and free space; "region", the region's mean share of the map's area.
    """
    kinds, rows = measurements(model, source, scale, config)
    parts = {"all": rows, **{kind: rows[kinds == kind] for kind in np.unique(kinds)}}
    return {str(kind): _summary(part) for kind, part in sorted(parts.items())}


@torch.no_grad()
def measurements(
    model: nn.Module, source: PathSource, scale: NetworkScale, config: TrainConfig
) -> tuple[NDArray[np.str_], NDArray[np.float64]]:
    """What `validate` averages.

    Returns:
        (N,) kind of each problem's map and (N, 6) rows: loss; number of selected anchors, of
        positive ones and of those that are both; connected; region share.
    """
    was_training = model.training
    model.eval()
    kinds: list[str] = []
    rows: list[NDArray[np.float64]] = []
    for indices in _index_batches(len(source), config):
        kinds += [source.recipes[source[index].map_id].kind for index in indices]
        rows += _measure(model, [load_example(source, i) for i in indices], scale, config)
    model.train(was_training)
    return np.array(kinds), np.array(rows)


def _index_batches(available: int, config: TrainConfig) -> Iterator[list[int]]:
    count = min(config.validation_problems, available)
    indices = np.linspace(0, available, count, endpoint=False).astype(int)
    for first in range(0, count, config.batch_size):
        yield indices[first : first + config.batch_size].tolist()


def _measure(
    model: nn.Module, examples: list[Example], scale: NetworkScale, config: TrainConfig
) -> list[NDArray[np.float64]]:
    """A row a problem; its loss is that of its batch."""
    batch = encode_examples(examples, scale).to(next(model.parameters()).device)
    proposal = model(batch.map.float(), batch.query)
    loss = float(proposal_loss(proposal, batch, config))
    selected, positive, inside = (
        tensor[:, 0].cpu().numpy()
        for tensor in (
            proposal.logits.sigmoid() >= THRESHOLD,
            batch.positive > THRESHOLD,
            batch.inside > 0,
        )
    )
    rows = []
    for example, s, p, of_map in zip(examples, selected, positive, inside, strict=True):
        height, width = of_map[:, 0].sum(), of_map[0].sum()
        s, p = s[:height, :width], p[:height, :width]
        quality = region_quality(example, s, scale)
        rows.append(np.array([loss, s.sum(), p.sum(), (s & p).sum(), *quality]))
    return rows


def region_quality(
    example: Example, selected: NDArray[np.bool_], scale: NetworkScale
) -> tuple[bool, float]:
    """Judge the region of one problem.

    Args:
        example: The problem.
        selected: (h, w) bool, the anchors of the region.
        scale: The network's scale.

    Returns:
        Whether start and goal are joined inside region and free space (4-connected pixels), and
        the region's share of the map's area.
    """
    mask = region_mask(selected, scale)
    free = network_map(example.blocked, example.resolution, scale) == 0
    start, goal = (_pixel(state, scale) for state in (example.start, example.goal))
    rows, cols = (
        min(round(size * example.resolution / scale.resolution), limit)
        for size, limit in zip(example.blocked.shape, mask.shape, strict=True)
    )
    return connected(mask & free, start, goal), float(mask[:rows, :cols].mean())


def _pixel(state: NDArray[np.float64], scale: NetworkScale) -> tuple[int, int]:
    return int(state[1] / scale.resolution), int(state[0] / scale.resolution)


def _summary(rows: NDArray[np.float64]) -> Metrics:
    loss, selected, positive, both, joined, share = rows.T
    return {
        "problems": len(rows),
        "loss": float(loss.mean()),
        "precision": float(both.sum() / max(selected.sum(), 1)),
        "recall": float(both.sum() / max(positive.sum(), 1)),
        "connected": float(joined.mean()),
        "region": float(share.mean()),
    }
