"""All that a training needs to go on exactly where it stopped."""

from __future__ import annotations

import csv
import io
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import torch
from torch import nn, optim

from planformer.errors import InvalidWeights
from planformer.files import whole_file
from planformer.models import (
    MPTConfig,
    create_model,
    load_checkpoint,
    save_checkpoint,
)
from planformer.training.config import TrainConfig
from planformer.training.optimizer import create_optimizer
from planformer.training.validation import Metrics

CHECKPOINT = "checkpoint.pt"
LOG = "log.csv"


@dataclass
class TrainState:
    """A network in training.

    Attributes:
        network: Configuration of the network.
        model: The network.
        optimizer: Its optimiser.
        data: Settings of the data set, for the weights' card.
        step: Optimiser steps taken.
        seconds: Time spent, over all resumptions.
        history: One row for each validation and kind of map.
    """

    network: MPTConfig
    model: nn.Module
    optimizer: optim.Optimizer
    data: dict[str, Any]
    step: int = 0
    seconds: float = 0.0
    history: list[dict[str, Any]] = field(default_factory=list)

    def record(self, metrics: dict[str, Metrics], **measured: float) -> None:
        """Add a validation to the history."""
        for kind, values in metrics.items():
            common = {"step": self.step, "seconds": round(self.seconds, 1)}
            self.history.append({**common, **measured, "kind": kind, **values})

    def save(self, folder: Path, config: TrainConfig) -> None:
        """Write checkpoint and log; each file is replaced as a whole."""
        save_checkpoint(
            folder / CHECKPOINT,
            self.network,
            self.model,
            optimizer=self.optimizer.state_dict(),
            random_state=torch.get_rng_state(),
            training=config.to_dict(),
            data=self.data,
            step=self.step,
            seconds=self.seconds,
            history=self.history,
        )
        if self.history:
            with whole_file(folder / LOG) as file:
                file.write(_csv(self.history))


def new_state(network: MPTConfig, config: TrainConfig, data: dict[str, Any]) -> TrainState:
    """Fresh weights, drawn from PyTorch's random state."""
    model = _placed(create_model(network), config)
    return TrainState(network, model, create_optimizer(model, config), data)


def resumed_state(
    path: Path, network: MPTConfig, config: TrainConfig, data: dict[str, Any]
) -> TrainState:
    """Read a checkpoint and restore PyTorch's random state.

    Raises:
        InvalidWeights: The file is no checkpoint of a training of this network.
    """
    found, model, stored = load_checkpoint(path)
    if found != network:
        raise InvalidWeights(
            f"{path} holds another network, {found}; asked for {network}: choose another folder"
        )
    model = _placed(model, config)
    optimizer = create_optimizer(model, config)
    try:
        optimizer.load_state_dict(stored["optimizer"])
        torch.set_rng_state(stored["random_state"])
        progress = {name: stored[name] for name in ("step", "seconds", "history")}
    except (KeyError, ValueError) as error:
        raise InvalidWeights(f"{path} is no checkpoint of this training: {error}") from error
    return TrainState(network, model, optimizer, data, **progress)


def _placed(model: nn.Module, config: TrainConfig) -> nn.Module:
    """Move a network to its device, in the layout whose convolutions are the fastest on a CPU."""
    layout = {"memory_format": torch.channels_last}
    return model.to(config.device).to(**layout)  # type: ignore[call-overload,no-any-return]


def _csv(rows: list[dict[str, Any]]) -> bytes:
    text = io.StringIO()
    writer = csv.DictWriter(text, fieldnames=list(rows[0]), lineterminator="\n")
    writer.writeheader()
    writer.writerows(
        {k: f"{v:.6g}" if isinstance(v, float) else v for k, v in row.items()} for row in rows
    )
    return text.getvalue().encode()
