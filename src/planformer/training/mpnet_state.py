"""All that a training of MPNet needs to go on exactly where it stopped."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import torch
from torch import optim

from planformer.errors import InvalidWeights, WeightsMismatch
from planformer.models.mpnet import MPNet
from planformer.models.storage import load_mpnet, save_planner
from planformer.training.folder import CHECKPOINT, write_log
from planformer.training.mpnet_config import MPNetOptimizer, MPNetTrainConfig
from planformer.training.resume import require_same_training


@dataclass
class MPNetState:
    """A network in training.

    Attributes:
        model: The network.
        optimizer: Its optimiser.
        data: Settings of the data set, for the weights' card.
        step: Optimiser steps taken.
        seconds: Time spent, over all resumptions.
        history: One row for each validation.
    """

    model: MPNet
    optimizer: optim.Optimizer
    data: dict[str, Any]
    step: int = 0
    seconds: float = 0.0
    history: list[dict[str, float]] = field(default_factory=list)

    def record(self, **measured: float) -> None:
        """Add a validation to the history."""
        self.history.append({"step": self.step, "seconds": round(self.seconds, 1), **measured})

    def save(self, folder: Path, config: MPNetTrainConfig) -> None:
        """Write checkpoint and log; each file is replaced as a whole."""
        save_planner(
            folder / CHECKPOINT,
            self.model,
            optimizer=self.optimizer.state_dict(),
            training=config.to_dict(),
            data=self.data,
            step=self.step,
            seconds=self.seconds,
            history=self.history,
        )
        write_log(folder, self.history)


def mpnet_state(
    folder: Path, config: MPNetTrainConfig, data: dict[str, Any], device: torch.device
) -> MPNetState:
    """The training that a folder holds, or a new one with random weights.

    Raises:
        InvalidWeights: The folder's checkpoint is damaged or no checkpoint of a training.
        WeightsMismatch: It is of another network, of other data or of settings that would make
            the training another one.
    """
    path = folder / CHECKPOINT
    if not path.exists():
        model = _placed(MPNet(config.network), device)
        return MPNetState(model, _optimizer(model, config), data)
    model, stored = load_mpnet(path)
    model = _placed(model, device)
    try:
        require_same_training(path, stored, config.to_dict(), data)
        optimizer = _optimizer(model, config)
        optimizer.load_state_dict(stored["optimizer"])
        progress = {name: stored[name] for name in ("step", "seconds", "history")}
    except WeightsMismatch:
        raise
    except (AttributeError, KeyError, TypeError, ValueError) as error:
        raise InvalidWeights(f"{path} is no checkpoint of a training: {error!r}") from error
    return MPNetState(model, optimizer, data, **progress)


def _optimizer(model: MPNet, config: MPNetTrainConfig) -> optim.Optimizer:
    kind = optim.Adam if config.optimizer is MPNetOptimizer.ADAM else optim.Adagrad
    return kind(model.parameters(), lr=config.learning_rate)


def _placed(model: MPNet, device: torch.device) -> MPNet:
    """Move a network to its device, in the layout whose convolutions are the fastest on a CPU."""
    layout = {"memory_format": torch.channels_last}
    return model.to(device).to(**layout)  # type: ignore[call-overload,no-any-return]
