"""Settings of a training run."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from enum import Enum
from typing import Any

from planformer.errors import InvalidParameter
from planformer.models import CompactBody, MPTConfig

_COMPACT_ONLY = ("learning_rate", "weight_decay", "positive_weight")
"""Settings of the compact recipe that the paper's takes no notice of."""


class Recipe(str, Enum):
    """How a network is optimised.

    PAPER is the paper's: Adam with an inverse square root schedule after a warm-up, and a loss
    over all positive anchors and as many random negative ones. COMPACT is AdamW with a cosine
    schedule, and a loss over all anchors with the positive ones weighted up.
    """

    PAPER = "paper"
    COMPACT = "compact"


@dataclass(frozen=True)
class TrainConfig:
    """Settings of a training run.

    The run ends after `steps` or after `seconds` of training, whichever comes first. The cosine
    schedule follows the steps where they are given and the seconds otherwise; only with steps is
    a run reproducible.

    Attributes:
        recipe: Loss and optimiser.
        batch_size: Problems a step.
        steps: Optimiser steps of the whole run; None = as many as the seconds allow.
        seconds: Duration of the training, summed over all resumptions; None = no limit.
        learning_rate: Peak learning rate of the compact recipe.
        weight_decay: Weight decay of the compact recipe.
        warmup_steps: Steps of rising learning rate; the paper used 3200 with its recipe.
        positive_weight: Weight of positive anchors in the compact recipe; more connects more
            starts with their goals, in larger regions.
        initial: Checkpoint whose weights a new training starts from; None = random weights. A
            training that goes on ignores it.
        teacher: Checkpoint of a network that this one learns to imitate, with half of the loss.
        augment: Flip, turn and reverse the problems at random.
        bfloat16: Compute in bfloat16 where it is safe (autocast).
        seed: Seed of the weights, the order of the problems and the augmentation.
        workers: Processes that prepare problems; 0 = this one does.
        threads: Threads that PyTorch may use on the CPU; None = its own choice.
        device: PyTorch device to train on.
        devices: Number of such devices that share each batch, one process each.
        validate_every: Steps between validations.
        validation_problems: Number of validation problems, evenly spread over the data set.
        checkpoint_seconds: Seconds between checkpoints.

    Raises:
        InvalidParameter: A value is out of range or for another recipe, or the run would never end.
    """

    recipe: Recipe = Recipe.COMPACT
    batch_size: int = 32
    steps: int | None = None
    seconds: float | None = None
    learning_rate: float = 1.5e-3
    weight_decay: float = 0.02
    warmup_steps: int = 50
    positive_weight: float = 8.0
    initial: str | None = None
    teacher: str | None = None
    augment: bool = True
    bfloat16: bool = True
    seed: int = 0
    workers: int = 1
    threads: int | None = None
    device: str = "cpu"
    devices: int = 1
    validate_every: int = 200
    validation_problems: int = 240
    checkpoint_seconds: float = 120.0

    def __post_init__(self) -> None:
        try:
            object.__setattr__(self, "recipe", Recipe(self.recipe))
        except ValueError:
            valid = ", ".join(recipe.value for recipe in Recipe)
            raise InvalidParameter(f"recipe must be one of {valid}; got {self.recipe!r}") from None
        if self.steps is None and self.seconds is None:
            raise InvalidParameter("a training needs a number of steps or of seconds; got neither")
        self._require_at_least(
            1, "batch_size steps validate_every validation_problems threads devices"
        )
        self._require_at_least(0, "warmup_steps seed workers weight_decay")
        if self.batch_size % self.devices:
            raise InvalidParameter(
                f"batch_size must be a multiple of devices; got {self.batch_size} for "
                f"{self.devices}"
            )
        for name in ("seconds", "learning_rate", "positive_weight", "checkpoint_seconds"):
            value = getattr(self, name)
            if value is not None and not (math.isfinite(value) and value > 0):
                raise InvalidParameter(f"{name} must be finite and > 0; got {value}")
        self._require_used()

    def _require_at_least(self, least: int, names: str) -> None:
        for name in names.split():
            value = getattr(self, name)
            if value is not None and not value >= least:
                raise InvalidParameter(f"{name} must be >= {least}; got {value}")

    def _require_used(self) -> None:
        """Refuse a setting that would change nothing."""
        for name in self._unused:
            value = getattr(self, name)
            if value != getattr(type(self), name):
                raise InvalidParameter(
                    f"{name} belongs to the recipe 'compact' and changes nothing in the recipe "
                    f"'paper'; got {value}: leave it out or choose the recipe 'compact'"
                )

    @property
    def _unused(self) -> tuple[str, ...]:
        """Names of the settings that the recipe takes no notice of."""
        return _COMPACT_ONLY if self.recipe is Recipe.PAPER else ()

    def to_dict(self) -> dict[str, Any]:
        """The settings that the recipe uses, as JSON-compatible values."""
        values = {**asdict(self), "recipe": self.recipe.value}
        return {name: value for name, value in values.items() if name not in self._unused}


def config_for(network: MPTConfig, **given: Any) -> TrainConfig:
    """Settings for a network: those given and not None; the rest are its recipe's defaults.

    The paper's networks, the U-Nets among them, have the paper's recipe, others the compact one.

    Raises:
        InvalidParameter: A value is out of range.
    """
    given = {key: value for key, value in given.items() if value is not None}
    usual = Recipe.COMPACT if isinstance(network.body, CompactBody) else Recipe.PAPER
    defaults: dict[str, Any] = {"recipe": usual}
    if given.get("recipe", usual) == Recipe.PAPER:
        defaults["warmup_steps"] = 3200
    return TrainConfig(**defaults | given)
