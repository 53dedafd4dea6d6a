"""Settings of a training of MPNet."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass, field
from enum import Enum
from typing import Any

from planformer.errors import InvalidParameter
from planformer.models.mpnet import MPNetConfig


class MPNetOptimizer(str, Enum):
    """ADAGRAD was published, at a learning rate of 1e-4 for 70 epochs; ADAM is faster."""

    ADAM = "adam"
    ADAGRAD = "adagrad"


@dataclass(frozen=True)
class MPNetTrainConfig:
    """Settings of a training of MPNet.

    The run ends after `steps` or after `seconds` of training, whichever comes first. The learning
    rate falls along a cosine over the steps where they are given and over the seconds otherwise;
    only with steps is a run reproducible.

    Attributes:
        network: The network.
        steps: Optimiser steps of the whole run; None = as many as the seconds allow.
        seconds: Duration of the training, summed over all resumptions; None = no limit.
        maps: Maps a step.
        waypoints: Waypoints to predict on each of them; a map is encoded once for all of its own.
        optimizer: The optimiser.
        learning_rate: Learning rate at the beginning.
        augment: Flip and turn the maps at random.
        bfloat16: Compute in bfloat16 where it is safe (autocast).
        seed: Seed of the weights, the waypoints and the dropout.
        threads: Threads that PyTorch may use on the CPU; None = its own choice.
        device: PyTorch device to train on.
        validate_every: Steps between validations.
        validation_maps: Number of validation maps, evenly spread over the data set.
        checkpoint_seconds: Seconds between checkpoints.

    Raises:
        InvalidParameter: A value is out of range, or the run would never end.
    """

    network: MPNetConfig = field(default_factory=MPNetConfig)
    steps: int | None = None
    seconds: float | None = None
    maps: int = 4
    waypoints: int = 128
    optimizer: MPNetOptimizer = MPNetOptimizer.ADAM
    learning_rate: float = 1e-3
    augment: bool = True
    bfloat16: bool = True
    seed: int = 0
    threads: int | None = None
    device: str = "cpu"
    validate_every: int = 200
    validation_maps: int = 60
    checkpoint_seconds: float = 120.0

    def __post_init__(self) -> None:
        try:
            object.__setattr__(self, "optimizer", MPNetOptimizer(self.optimizer))
        except ValueError:
            valid = ", ".join(optimizer.value for optimizer in MPNetOptimizer)
            raise InvalidParameter(
                f"optimizer must be one of {valid}; got {self.optimizer!r}"
            ) from None
        if self.steps is None and self.seconds is None:
            raise InvalidParameter("a training needs a number of steps or of seconds; got neither")
        for name in ("steps", "maps", "waypoints", "threads", "validate_every", "validation_maps"):
            value = getattr(self, name)
            if value is not None and value < 1:
                raise InvalidParameter(f"{name} must be >= 1; got {value}")
        for name in ("seconds", "learning_rate", "checkpoint_seconds"):
            value = getattr(self, name)
            if value is not None and not (math.isfinite(value) and value > 0):
                raise InvalidParameter(f"{name} must be finite and > 0; got {value}")
        if self.seed < 0:
            raise InvalidParameter(f"seed must be >= 0; got {self.seed}")

    def to_dict(self) -> dict[str, Any]:
        """The settings as JSON-compatible values."""
        values = {**asdict(self), "optimizer": self.optimizer.value}
        return {**values, "network": self.network.to_dict()}
