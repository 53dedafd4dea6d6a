"""All that a training needs to go on exactly where it stopped."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import torch
from torch import nn, optim

from planformer.errors import InvalidWeights, WeightsMismatch
from planformer.models import (
    MPTConfig,
    create_model,
    load_checkpoint,
    save_checkpoint,
)
from planformer.training.config import TrainConfig
from planformer.training.folder import CHECKPOINT, write_log
from planformer.training.optimizer import create_optimizer
from planformer.training.resume import mismatch
from planformer.training.validation import Metrics

_MAY_CHANGE = (
    "bfloat16 checkpoint_seconds device devices initial seconds steps threads "
    "validate_every validation_problems workers"
)
"""Settings that may be others when a training goes on: they do not say what it learns."""

_NEW_FOLDER = ", with this file as the initial weights to start from"

_NO_METRICS = {"step", "seconds", "learning_rate", "train_loss", "kind"}
"""What a row of the history says beside a validation's metrics."""


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

    def last_metrics(self) -> dict[str, Metrics]:
        """The last validation by kind of map; empty where there was none."""
        return {
            row["kind"]: {name: value for name, value in row.items() if name not in _NO_METRICS}
            for row in self.history
            if row["step"] == self.history[-1]["step"]
        }

    def save(self, folder: Path, config: TrainConfig) -> None:
        """Write checkpoint and log; each file is replaced as a whole."""
        save_checkpoint(
            folder / CHECKPOINT,
            self.network,
            self.model,
            optimizer=self.optimizer.state_dict(),
            training=config.to_dict(),
            data=self.data,
            step=self.step,
            seconds=self.seconds,
            history=self.history,
        )
        write_log(folder, self.history)


def new_state(
    network: MPTConfig, config: TrainConfig, data: dict[str, Any], device: torch.device
) -> TrainState:
    """A training at its start, with random weights or those of `config.initial`.

    Raises:
        InvalidWeights: The initial checkpoint is damaged or of another network.
    """
    if config.initial is None:
        model: nn.Module = create_model(network)
    else:
        found, model, _ = load_checkpoint(Path(config.initial))
        what = f"the initial weights {config.initial} are of another network"
        _require_same(what, _flat(found), _flat(network), "start from the same network's")
    model = _placed(model, device)
    return TrainState(network, model, create_optimizer(model, config), data)


def resumed_state(
    path: Path,
    network: MPTConfig,
    config: TrainConfig,
    data: dict[str, Any],
    device: torch.device,
) -> TrainState:
    """Read a checkpoint.

    Raises:
        InvalidWeights: The file is damaged or no checkpoint of a training.
        WeightsMismatch: It is of another network, of other data or of settings that would make
            the training another one.
    """
    found, model, stored = load_checkpoint(path)
    try:
        settings = {k: v for k, v in stored["training"].items() if k not in _MAY_CHANGE.split()}
        for what, theirs, ours, remedy in (
            ("of another network", _flat(found), _flat(network), ""),
            ("of other data", stored["data"], data, _NEW_FOLDER),
            ("of other settings", settings, config.to_dict(), _NEW_FOLDER),
        ):
            _require_same(f"{path} is {what}", theirs, ours, "choose another folder" + remedy)
        model = _placed(model, device)
        optimizer = create_optimizer(model, config)
        optimizer.load_state_dict(stored["optimizer"])
        progress = {name: stored[name] for name in ("step", "seconds", "history")}
    except WeightsMismatch:
        raise
    except (AttributeError, KeyError, TypeError, ValueError) as error:
        raise InvalidWeights(f"{path} is no checkpoint of a training: {error!r}") from error
    return TrainState(network, model, optimizer, data, **progress)


def load_teacher(path: Path, network: MPTConfig, device: torch.device) -> nn.Module:
    """Read a network to imitate, ready to be asked.

    Raises:
        InvalidWeights: The file is damaged or no checkpoint.
        WeightsMismatch: The teacher does not see the world as the network does.
    """
    found, model, _ = load_checkpoint(path)
    theirs, ours = found.scale.to_dict(), network.scale.to_dict()
    _require_same(f"the teacher {path} sees another input", theirs, ours, "choose another teacher")
    return _placed(model, device).eval().requires_grad_(False)


def _flat(network: MPTConfig) -> dict[str, Any]:
    values = network.to_dict()
    return {**values.pop("body"), **values}


def _require_same(
    what: str, theirs: Mapping[str, Any], ours: Mapping[str, Any], remedy: str
) -> None:
    """Compare what both name: what only one does may be of another version.

    One data set and several name nothing in common, and are not the same.
    """
    common = [name for name in theirs if name in ours]
    names = [name for name in common if theirs[name] != ours[name]]
    if names or not common:
        raise mismatch(what, names, theirs, ours, remedy)


def _placed(model: nn.Module, device: torch.device) -> nn.Module:
    """Move a network to its device, in the layout whose convolutions are the fastest on a CPU."""
    layout = {"memory_format": torch.channels_last}
    return model.to(device).to(**layout)  # type: ignore[call-overload,no-any-return]
