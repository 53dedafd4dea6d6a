"""From stored paths to tensors, in an order that a resumed training takes up again."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple, Protocol

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor
from torch.utils.data import DataLoader, Dataset

from planformer.data.dataset import PathProblem
from planformer.data.recipe import MapRecipe
from planformer.data.spec import DatasetSpec
from planformer.encoding import (
    NetworkScale,
    anchor_headings,
    anchor_labels,
    anchor_points,
    encode_query,
    network_map,
)
from planformer.errors import InvalidDataset
from planformer.processes import interrupts_left_to_parent
from planformer.training.augmentation import Example, augment
from planformer.training.config import TrainConfig


class PathSource(Protocol):
    """Solved problems on maps; `planformer.data.dataset.PathDataset` is one."""

    @property
    def spec(self) -> DatasetSpec:
        """The settings that the data set was made with."""

    @property
    def recipes(self) -> Sequence[MapRecipe]:
        """The maps."""

    def __len__(self) -> int: ...

    def __getitem__(self, index: int, /) -> PathProblem: ...

    def blocked_map(self, map_id: int, /) -> NDArray[np.bool_]:
        """(H, W) bool, where the robot's centre must not be."""


class Batch(NamedTuple):
    """Tensors of some problems.

    Attributes:
        map: (B, 1, H, W) uint8, 1 = blocked.
        query: (B, C, H/s, W/s) float32.
        positive: (B, 1, h, w) float32, 1 at the anchors near the path.
        heading: (B, 2, h, w) float32 unit vectors at those anchors; (B, 0, h, w) in the plane.
    """

    map: Tensor
    query: Tensor
    positive: Tensor
    heading: Tensor


def load_example(source: PathSource, index: int) -> Example:
    """Problem number `index` with its map."""
    problem = source[index]
    blocked = source.blocked_map(problem.map_id)
    resolution = source.recipes[problem.map_id].resolution
    return Example(blocked, resolution, problem.start, problem.goal, problem.path)


def encode_example(example: Example, scale: NetworkScale) -> Batch:
    """Tensors of one problem, without the batch axis."""
    pixels = network_map(example.blocked, example.resolution, scale)
    anchors = anchor_points(pixels.shape[0], pixels.shape[1], scale)
    positive = anchor_labels(anchors, example.path)
    heading = (
        anchor_headings(anchors, example.path)
        if scale.headings
        else np.empty((0, *positive.shape), np.float32)
    )
    query = encode_query(pixels, example.start, example.goal, scale)
    arrays = (pixels[None], query, positive[None].astype(np.float32), heading)
    return Batch(*(torch.from_numpy(array) for array in arrays))


class Samples(Dataset[Batch]):
    """Encoded problems by (epoch, index); the same key gives the same augmentation.

    Args:
        source: The problems.
        scale: The network's scale.
        seed: Seed of the augmentation; None = as stored.
    """

    def __init__(self, source: PathSource, scale: NetworkScale, seed: int | None = None) -> None:
        self._source, self._scale, self._seed = source, scale, seed

    def __getitem__(self, key: tuple[int, int]) -> Batch:
        epoch, index = key
        example = load_example(self._source, index)
        if self._seed is not None:
            example = augment(example, np.random.default_rng([self._seed, epoch, index]))
        return encode_example(example, self._scale)


class ResumableBatches:
    """Endless batches of (epoch, index), each epoch in its own random order.

    Args:
        problems: Number of problems in the data set.
        batch_size: Problems a batch; the rest of an epoch that does not fill one is left out.
        seed: Seed of the order.
        step: Number of batches to skip.

    Raises:
        InvalidDataset: There are fewer problems than a batch needs.
    """

    def __init__(self, problems: int, batch_size: int, *, seed: int, step: int = 0) -> None:
        if problems < batch_size:
            raise InvalidDataset(
                f"a batch needs {batch_size} problems; the data set has {problems}"
            )
        self._problems, self._batch_size = problems, batch_size
        self._seed, self._step = seed, step

    def __iter__(self) -> Iterator[list[tuple[int, int]]]:
        in_epoch = self._problems // self._batch_size
        epoch, skipped = divmod(self._step, in_epoch)
        while True:
            order = np.random.default_rng([self._seed, epoch]).permutation(self._problems)
            for batch in range(skipped, in_epoch):
                indices = order[batch * self._batch_size :][: self._batch_size]
                yield [(epoch, int(index)) for index in indices]
            epoch, skipped = epoch + 1, 0


def training_batches(
    source: PathSource, scale: NetworkScale, config: TrainConfig, *, step: int
) -> Iterator[Batch]:
    """The batches of a training from a step on, prepared ahead by worker processes."""
    samples = Samples(source, scale, config.seed if config.augment else None)
    order = ResumableBatches(len(source), config.batch_size, seed=config.seed, step=step)
    options: dict[str, Any] = {"prefetch_factor": 4} if config.workers else {}
    loader = DataLoader(
        samples,
        batch_sampler=order,
        num_workers=config.workers,
        generator=torch.Generator(),  # the loader must not draw from the training's
        **options,
    )
    with interrupts_left_to_parent():
        return iter(loader)  # starts the workers
