"""The training loop."""

from __future__ import annotations

import dataclasses
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import torch
from torch import nn

from planformer.errors import InvalidParameter
from planformer.models import MPTConfig
from planformer.training.config import Recipe, TrainConfig
from planformer.training.interrupt import GracefulInterrupt
from planformer.training.losses import proposal_loss
from planformer.training.optimizer import learning_rate
from planformer.training.samples import Batch, PathSource, training_batches
from planformer.training.state import CHECKPOINT, TrainState, new_state, resumed_state
from planformer.training.validation import Metrics, validate

_MAX_GRADIENT_NORM = 1.0


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
    a checkpoint the training goes on from there; with the same settings and a number of steps on
    one device, an interrupted training ends with the weights of an uninterrupted one. Ctrl-C stops
    after the current step.

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
        InvalidDataset: There are fewer problems than a batch needs.
        InvalidWeights: The folder's checkpoint is damaged or of another network.
        InvalidParameter: Recipe or device do not fit.
    """
    if config.threads is not None:
        torch.set_num_threads(config.threads)
    folder = Path(output)
    with torch.random.fork_rng(devices=[]), GracefulInterrupt() as interrupt:
        torch.manual_seed(config.seed)
        state = _state(folder, network, config, data)
        run = _Run(state, config, data, validation, folder, report or (lambda progress: None))
        return run.until_done(interrupt)


def _state(folder: Path, network: MPTConfig, config: TrainConfig, data: PathSource) -> TrainState:
    description = dataclasses.asdict(data.spec)
    try:
        torch.empty(0, device=config.device)
    except (RuntimeError, AssertionError) as error:
        raise InvalidParameter(f"device {config.device!r} is not usable: {error}") from error
    if (folder / CHECKPOINT).exists():
        return resumed_state(folder / CHECKPOINT, network, config, description)
    return new_state(network, config, description)


@dataclass
class _Run:
    """One call of `train`."""

    state: TrainState
    config: TrainConfig
    data: PathSource
    validation: PathSource
    folder: Path
    report: Callable[[Progress], None]
    metrics: dict[str, Metrics] = field(default_factory=dict)

    def until_done(self, interrupt: GracefulInterrupt) -> TrainResult:
        state, config, scale = self.state, self.config, self.state.network.scale
        batches = training_batches(self.data, scale, config, step=state.step)
        began, saved = time.perf_counter() - state.seconds, state.seconds
        while not (finished := self._at_limit()) and not interrupt.requested:
            rate = learning_rate(config, step=state.step, seconds=state.seconds)
            loss = self._step(next(batches), rate)
            state.step += 1
            state.seconds = time.perf_counter() - began
            is_due = state.step % config.validate_every == 0 or self._at_limit()
            validated = self._validate(loss, rate) if is_due else None
            state.seconds = time.perf_counter() - began
            if validated or state.seconds - saved > config.checkpoint_seconds:
                state.save(self.folder, config)
                saved = state.seconds
            self.report(Progress(state.step, state.seconds, rate, loss, validated))
        state.save(self.folder, config)
        return TrainResult(self.folder / CHECKPOINT, state.step, finished, self.metrics)

    def _at_limit(self) -> bool:
        steps, seconds = self.config.steps, self.config.seconds
        return (steps is not None and self.state.step >= steps) or (
            seconds is not None and self.state.seconds >= seconds
        )

    def _step(self, batch: Batch, rate: float) -> float:
        """Take an optimiser step; returns the loss before it."""
        config, model, optimizer = self.config, self.state.model, self.state.optimizer
        model.train()
        for group in optimizer.param_groups:
            group["lr"] = rate
        batch = Batch(*(tensor.to(config.device) for tensor in batch))
        device_type = torch.device(config.device).type
        with torch.autocast(device_type, torch.bfloat16, enabled=config.bfloat16):
            proposal = model(batch.map.float(), batch.query)
        loss = proposal_loss(proposal, batch, config)
        optimizer.zero_grad(set_to_none=True)
        loss.backward()  # type: ignore[no-untyped-call]
        if config.recipe is Recipe.COMPACT:
            nn.utils.clip_grad_norm_(model.parameters(), _MAX_GRADIENT_NORM)
        optimizer.step()
        return float(loss.detach())

    def _validate(self, loss: float, rate: float) -> dict[str, Metrics]:
        state = self.state
        with torch.random.fork_rng(devices=[]):  # measuring must not change the training
            torch.manual_seed(0)
            metrics = validate(state.model, self.validation, state.network.scale, self.config)
        state.record(metrics, learning_rate=rate, train_loss=loss)
        self.metrics = metrics
        return metrics
