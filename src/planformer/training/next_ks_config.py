"""Settings of a training of NEXT's network."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass, field
from typing import Any

from planformer.errors import InvalidParameter
from planformer.models.next_ks import NextConfig


@dataclass(frozen=True)
class NextTrainConfig:
    """Settings of a training of NEXT's network.

    The run ends after `steps` or after `seconds` of training, whichever comes first. The schedules
    follow the steps where they are given and the seconds otherwise; only with steps is a run
    reproducible.

    Attributes:
        network: The network.
        steps: Optimiser steps of the whole run; None = as many as the seconds allow.
        seconds: Duration of the training, summed over all resumptions; None = no limit.
        problems: Problems a step.
        states: States a problem, of which it learns the next step and the value.
        imitation: Part of the training, from 0 to 1, that only imitates the data set's paths;
            after it the network also searches.
        searches: Problems of a step that the network then searches on.
        samples: Samples of a search.
        learning_rate: Learning rate at the beginning; it falls along a cosine.
        weight_decay: Weight of the squared weights in the loss.
        augment: Flip, turn and reverse the problems at random.
        bfloat16: Compute in bfloat16 where it is safe (autocast).
        seed: Seed of the weights, of the order of the problems and of the searches.
        threads: Threads that PyTorch may use on the CPU; None = its own choice.
        device: PyTorch device to train on.
        validate_every: Steps between validations.
        validation_problems: Number of validation problems, evenly spread over the data set.
        checkpoint_seconds: Seconds between checkpoints.

    Raises:
        InvalidParameter: A value is out of range, or the run would never end.
    """

    network: NextConfig = field(default_factory=NextConfig)
    steps: int | None = None
    seconds: float | None = None
    problems: int = 8
    states: int = 16
    imitation: float = 0.5
    searches: int = 2
    samples: int = 200
    learning_rate: float = 1e-3
    weight_decay: float = 1e-6
    augment: bool = True
    bfloat16: bool = True
    seed: int = 0
    threads: int | None = None
    device: str = "cpu"
    validate_every: int = 200
    validation_problems: int = 96
    checkpoint_seconds: float = 120.0

    def __post_init__(self) -> None:
        if self.steps is None and self.seconds is None:
            raise InvalidParameter("a training needs a number of steps or of seconds; got neither")
        self._require_at_least(
            1, "steps problems states samples threads validate_every validation_problems"
        )
        self._require_at_least(0, "searches weight_decay seed")
        if self.searches > self.problems:
            raise InvalidParameter(
                f"searches must be at most the {self.problems} problems of a step; got "
                f"{self.searches}"
            )
        if not 0.0 <= self.imitation <= 1.0:
            raise InvalidParameter(f"imitation must be between 0 and 1; got {self.imitation}")
        for name in ("seconds", "learning_rate", "checkpoint_seconds"):
            value = getattr(self, name)
            if value is not None and not (math.isfinite(value) and value > 0):
                raise InvalidParameter(f"{name} must be finite and > 0; got {value}")

    def _require_at_least(self, least: int, names: str) -> None:
        for name in names.split():
            value = getattr(self, name)
            if value is not None and not value >= least:
                raise InvalidParameter(f"{name} must be >= {least}; got {value}")

    def to_dict(self) -> dict[str, Any]:
        """The settings as JSON-compatible values."""
        return {**asdict(self), "network": self.network.to_dict()}
