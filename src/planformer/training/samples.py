"""From stored paths to tensors, in an order that a resumed training takes up again."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial
from typing import Any, NamedTuple

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor
from torch.utils.data import DataLoader, Dataset

from planformer.encoding import (
    NetworkScale,
    anchor_headings,
    anchor_labels,
    anchor_offsets,
    anchor_points,
    encode_query,
    network_map,
)
from planformer.errors import InvalidDataset
from planformer.processes import interrupts_left_to_parent
from planformer.training.augmentation import Example, augment
from planformer.training.config import TrainConfig
from planformer.training.sources import PathSource, load_example


class Batch(NamedTuple):
    """Tensors of some problems; smaller maps are padded to the largest of the batch.

    Attributes:
        map: (B, 1, H, W) uint8, 1 = blocked, as everything beyond a map is.
        query: (B, C, H/s, W/s) float32.
        positive: (B, 1, h, w) float32, 1 at the anchors near the path.
        heading: (B, 2, h, w) float32 direction of travel at those anchors; (B, 0, h, w) without
            headings.
        offset: (B, 2, h, w) float32 way in metres from each anchor to the path; (B, 0, h, w)
            without offsets.
        inside: (B, 1, h, w) float32, 1 at the anchors of the problem's own map, 0 beyond it.
    """

    map: Tensor
    query: Tensor
    positive: Tensor
    heading: Tensor
    offset: Tensor
    inside: Tensor

    def to(self, device: torch.device) -> Batch:
        """The batch on a device."""
        return Batch(*(tensor.to(device, non_blocking=True) for tensor in self))


def encode_examples(examples: Sequence[Example], scale: NetworkScale) -> Batch:
    """Tensors of some problems.

    The maps are padded before the rest is made from them, so that a network sees the same as
    when it guides a planner on a map with a blocked margin.

    Args:
        examples: One problem or more.
        scale: The network's scale.
    """
    maps = [network_map(e.blocked, e.resolution, scale) for e in examples]
    height, width = (max(sizes) for sizes in zip(*(pixels.shape for pixels in maps), strict=True))
    anchors = anchor_points(height, width, scale)
    rows = []
    for example, pixels in zip(examples, maps, strict=True):
        padded = np.ones((height, width), np.uint8)
        padded[: pixels.shape[0], : pixels.shape[1]] = pixels
        query = encode_query(padded, example.start, example.goal, scale)
        inside = np.zeros(anchors.shape[:2], np.float32)
        inside[: pixels.shape[0] // scale.stride, : pixels.shape[1] // scale.stride] = 1.0
        positive = inside * anchor_labels(anchors, example.path)
        heading = inside * _headings(anchors, example.path, scale)
        offset = inside * _offsets(anchors, example.path, scale)
        rows.append((padded[None], query, positive[None], heading, offset, inside[None]))
    return Batch(*(torch.from_numpy(np.stack(column)) for column in zip(*rows, strict=True)))


def _headings(
    anchors: NDArray[np.float64], path: NDArray[np.float64], scale: NetworkScale
) -> NDArray[np.float32]:
    """(2, h, w) labels of a network with headings; (0, h, w) otherwise."""
    if scale.headings:
        return anchor_headings(anchors, path)
    return np.empty((0, *anchors.shape[:2]), np.float32)


def _offsets(
    anchors: NDArray[np.float64], path: NDArray[np.float64], scale: NetworkScale
) -> NDArray[np.float32]:
    """(2, h, w) labels of a network with offsets; (0, h, w) otherwise."""
    if scale.offsets:
        return np.moveaxis(anchor_offsets(anchors, path), -1, 0).astype(np.float32)
    return np.empty((0, *anchors.shape[:2]), np.float32)


class Samples(Dataset[Example]):
    """Problems by (epoch, index); the same key gives the same augmentation.

    Args:
        source: The problems.
        seed: Seed of the augmentation; None = as stored.
    """

    def __init__(self, source: PathSource, seed: int | None = None) -> None:
        self._source, self._seed = source, seed

    def __getitem__(self, key: tuple[int, int]) -> Example:
        epoch, index = key
        example = load_example(self._source, index)
        if self._seed is None:
            return example
        return augment(example, np.random.default_rng([self._seed, epoch, index]))


class ResumableBatches:
    """Endless batches of (epoch, index), each epoch in its own random order.

    Args:
        problems: Number of problems in the data set.
        batch_size: Problems a batch; the rest of an epoch that does not fill one is left out.
        seed: Seed of the order.
        step: Number of batches to skip.
        share: This process and the number of processes that take an equal part of each batch.

    Raises:
        InvalidDataset: There are fewer problems than a batch needs.
    """

    def __init__(
        self,
        problems: int,
        batch_size: int,
        *,
        seed: int,
        step: int = 0,
        share: tuple[int, int] = (0, 1),
    ) -> None:
        if problems < batch_size:
            raise InvalidDataset(
                f"a batch needs {batch_size} problems; the data set has {problems}"
            )
        self._problems, self._batch_size = problems, batch_size
        self._seed, self._step, self._share = seed, step, share

    def __iter__(self) -> Iterator[list[tuple[int, int]]]:
        rank, count = self._share
        in_epoch = self._problems // self._batch_size
        epoch, skipped = divmod(self._step, in_epoch)
        while True:
            order = np.random.default_rng([self._seed, epoch]).permutation(self._problems)
            for batch in range(skipped, in_epoch):
                indices = order[batch * self._batch_size :][: self._batch_size]
                yield [(epoch, int(index)) for index in indices[rank::count]]
            epoch, skipped = epoch + 1, 0


def training_batches(
    source: PathSource,
    scale: NetworkScale,
    config: TrainConfig,
    *,
    step: int,
    share: tuple[int, int] = (0, 1),
) -> Iterator[Batch]:
    """The batches of a training from a step on, prepared ahead by worker processes."""
    order = ResumableBatches(
        len(source), config.batch_size, seed=config.seed, step=step, share=share
    )
    options: dict[str, Any] = {"prefetch_factor": 4} if config.workers else {}
    loader = DataLoader(
        Samples(source, config.seed if config.augment else None),
        batch_sampler=order,
        collate_fn=partial(encode_examples, scale=scale),
        num_workers=config.workers,
        pin_memory=torch.device(config.device).type == "cuda",
        generator=torch.Generator(),  # the loader must not draw from the training's
        **options,
    )
    with interrupts_left_to_parent():
        return iter(loader)  # starts the workers
