"""The training loop."""

from __future__ import annotations

import dataclasses
import math
import time
from collections.abc import Callable, Iterator
from contextlib import nullcontext
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import torch
from torch import Tensor, nn

from planformer.errors import TrainingDiverged
from planformer.models import MPTConfig
from planformer.training.config import Recipe, TrainConfig
from planformer.training.devices import Devices
from planformer.training.fit import require_fit
from planformer.training.folder import CHECKPOINT, claimed
from planformer.training.interrupt import GracefulInterrupt
from planformer.training.losses import imitation_loss, proposal_loss
from planformer.training.optimizer import learning_rate
from planformer.training.samples import Batch, training_batches
from planformer.training.sources import PathSource
from planformer.training.state import (
    TrainState,
    load_teacher,
    new_state,
    resumed_state,
)
from planformer.training.validation import Metrics, validate

_MAX_GRADIENT_NORM = {Recipe.COMPACT: 1.0, Recipe.PAPER: math.inf}
_GENTLER = {
    Recipe.COMPACT: "a smaller learning rate",
    Recipe.PAPER: "more warm-up steps or the recipe 'compact'",
}
"""What may help a training that diverged."""


@dataclass(frozen=True)
class Progress:
    """What a step of the training reports.

    Attributes:
        step: Optimiser steps taken so far.
        seconds: Training time so far, over all resumptions.
        learning_rate: Learning rate of the step.
        loss: Loss of the step's batch.
        metrics: Validation metrics by kind of map; None where the step was not validated.
    """

    step: int
    seconds: float
    learning_rate: float
    loss: float
    metrics: dict[str, Metrics] | None


@dataclass(frozen=True)
class TrainResult:
    """How a training ended.

    Attributes:
        checkpoint: The file with weights and state.
        step: Optimiser steps taken.
        finished: False where it was interrupted; the same call resumes it.
        metrics: The last validation by kind of map; empty where there was none.
    """

    checkpoint: Path
    step: int
    finished: bool
    metrics: dict[str, Metrics]


def train(
    network: MPTConfig,
    config: TrainConfig,
    data: PathSource,
    output: str | Path,
    *,
    validation: PathSource,
    report: Callable[[Progress], None] | None = None,
) -> TrainResult:
    """Train a network, or go on with a training that was stopped.

    The folder receives ``checkpoint.pt`` and ``log.csv``, each replaced as a whole. Where it holds
    a checkpoint the training goes on from there, however it was stopped; with a number of steps, on
    a CPU, it ends with the weights of an uninterrupted one, bit by bit. Ctrl-C stops after the
    current step.

    With `config.devices` > 1 the program runs once for each device, with the same arguments, and
    all of its processes train here together. The first alone validates, reports and writes (see
    `is_first_process`). A program can do so once.

    Args:
        network: The network.
        config: Recipe, limits and data handling.
        data: Problems to learn from.
        output: Folder of the training.
        validation: Problems on other maps.
        report: Called after every step.

    Returns:
        How it ended.

    Raises:
        InvalidDataset: There are fewer problems than a batch needs, or they are another robot's.
        InvalidParameter: The device is not usable, the recipe does not suit the network, or another
            process trains in the folder.
        InvalidWeights: The folder's checkpoint, the initial weights or the teacher are damaged.
        WeightsMismatch: They do not fit: another network, other data, other settings.
        TrainingDiverged: The loss or its gradient is infinite or no number; the folder keeps the
            last checkpoint.
        MissingExtra: More than one device, and Lightning Fabric is not installed.
    """
    require_fit(network, config.recipe, data, validation)
    if config.threads is not None:
        torch.set_num_threads(config.threads)
    folder = Path(output)
    with (
        GracefulInterrupt() as interrupt,
        torch.random.fork_rng(devices=[]),
        Devices(config) as devices,
        claimed(folder) if devices.is_first else nullcontext(),
    ):
        torch.manual_seed(config.seed)
        state = _state(folder, network, config, data, devices)
        share = (devices.rank, devices.count)
        batches = training_batches(data, network.scale, config, step=state.step, share=share)
        # No name for the run: a shared model must be gone before the devices part (see `Devices`).
        return _Run(state, config, folder, devices, validation, report).until_done(
            batches, interrupt
        )


def _state(
    folder: Path, network: MPTConfig, config: TrainConfig, data: PathSource, devices: Devices
) -> TrainState:
    description = dataclasses.asdict(data.spec)
    if (folder / CHECKPOINT).exists():
        return resumed_state(folder / CHECKPOINT, network, config, description, devices.device)
    return new_state(network, config, description, devices.device)


class _Run:
    """One call of `train`."""

    def __init__(
        self,
        state: TrainState,
        config: TrainConfig,
        folder: Path,
        devices: Devices,
        validation: PathSource,
        report: Callable[[Progress], None] | None,
    ) -> None:
        self.state, self.config, self.folder, self.devices = state, config, folder, devices
        self.validation, self.report = validation, report
        self.teacher = (
            None
            if config.teacher is None
            else load_teacher(Path(config.teacher), state.network, devices.device)
        )
        self.model = devices.synchronised(state.model)
        self.began = time.perf_counter() - state.seconds

    def until_done(self, batches: Iterator[Batch], interrupt: GracefulInterrupt) -> TrainResult:
        state, config = self.state, self.config
        saved = state.seconds
        while not (finished := self._at_limit()) and not self._any(interrupt.requested):
            rate = learning_rate(config, step=state.step, seconds=state.seconds)
            loss = self._step(next(batches), rate)
            state.step += 1
            self._read_clock()
            metrics = None
            if state.step % config.validate_every == 0 or self._at_limit():
                metrics = self._validate(loss, rate)
                self._read_clock()
            if metrics or state.seconds - saved > config.checkpoint_seconds:
                self._save()
                saved = state.seconds
            self._report(Progress(state.step, state.seconds, rate, loss, metrics))
        self._save()
        return TrainResult(self.folder / CHECKPOINT, state.step, finished, state.last_metrics())

    def _read_clock(self) -> None:
        """Set the training time, the same on all devices."""
        (self.state.seconds,) = self.devices.mean(time.perf_counter() - self.began)

    def _any(self, flag: bool) -> bool:
        (share,) = self.devices.mean(flag)
        return share > 0

    def _at_limit(self) -> bool:
        steps, seconds = self.config.steps, self.config.seconds
        return (steps is not None and self.state.step >= steps) or (
            seconds is not None and self.state.seconds >= seconds
        )

    def _step(self, batch: Batch, rate: float) -> float:
        """Take an optimiser step; returns the loss before it."""
        config, optimizer = self.config, self.state.optimizer
        self.model.train()
        torch.manual_seed(self._seed())
        for group in optimizer.param_groups:
            group["lr"] = rate
        loss = self._loss(batch.to(self.devices.device))
        optimizer.zero_grad(set_to_none=True)
        loss.backward()  # type: ignore[no-untyped-call]
        norm = nn.utils.clip_grad_norm_(
            self.state.model.parameters(), _MAX_GRADIENT_NORM[config.recipe]
        )
        (mean,) = self.devices.mean(float(loss.detach()))
        if not math.isfinite(mean + float(norm)):
            raise self._diverged(mean, rate)
        optimizer.step()
        return mean

    def _seed(self) -> int:
        """Seed of a step, so that a resumed training needs no random state of any device."""
        entropy = [self.config.seed, self.state.step, self.devices.rank]
        return int(np.random.SeedSequence(entropy).generate_state(1, np.uint64)[0] >> 1)

    def _loss(self, batch: Batch) -> Tensor:
        occupancy = batch.map.float()
        with torch.autocast(occupancy.device.type, torch.bfloat16, enabled=self.config.bfloat16):
            proposal = self.model(occupancy, batch.query)
            taught = None if self.teacher is None else self.teacher(occupancy, batch.query)
        mean = self.devices.mean_tensor
        loss = proposal_loss(proposal, batch, self.config, device_mean=mean)
        if taught is None:
            return loss
        imitation = imitation_loss(proposal.logits, taught.logits, batch.inside, device_mean=mean)
        return 0.5 * loss + 0.5 * imitation

    def _diverged(self, loss: float, rate: float) -> TrainingDiverged:
        file, step = self.folder / CHECKPOINT, self.state.step
        kept = (
            f"{file} holds the last good state" if file.exists() else "there is no checkpoint yet"
        )
        return TrainingDiverged(
            f"loss {loss} or its gradient is no finite number after {step} steps, at a learning "
            f"rate of {rate:.3g}; {kept}: try {_GENTLER[self.config.recipe]} in another folder",
            step=step,
            learning_rate=rate,
        )

    def _validate(self, loss: float, rate: float) -> dict[str, Metrics] | None:
        """Measure the network; the other processes wait at the next step's gradients."""
        if not self.devices.is_first:
            return None
        state = self.state
        torch.manual_seed(0)
        metrics = validate(state.model, self.validation, state.network.scale, self.config)
        state.record(metrics, learning_rate=rate, train_loss=loss)
        return metrics

    def _save(self) -> None:
        if self.devices.is_first:
            self.state.save(self.folder, self.config)

    def _report(self, progress: Progress) -> None:
        if self.report and self.devices.is_first:
            self.report(progress)
