"""The training of MPNet: encoder and planning network together, from experts' paths."""

from __future__ import annotations

import dataclasses
import math
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import torch
import torch.nn.functional as F
from torch import Tensor, nn

from planformer.errors import TrainingDiverged
from planformer.training.devices import usable_device
from planformer.training.folder import CHECKPOINT, claimed
from planformer.training.interrupt import GracefulInterrupt
from planformer.training.mpnet_config import MPNetTrainConfig
from planformer.training.mpnet_samples import WaypointBatch, WaypointSamples
from planformer.training.mpnet_state import mpnet_state
from planformer.training.sources import PathSource


@dataclass(frozen=True)
class MPNetProgress:
    """What a step of the training reports.

    Attributes:
        step: Optimiser steps taken so far.
        seconds: Training time so far, over all resumptions.
        learning_rate: Learning rate of the step.
        loss: Mean squared error of the step's waypoints, in the map's coordinates from -1 to 1.
        validation_loss: The same on the validation maps; None where it was not measured.
    """

    step: int
    seconds: float
    learning_rate: float
    loss: float
    validation_loss: float | None


@dataclass(frozen=True)
class MPNetTrainResult:
    """How a training ended.

    Attributes:
        checkpoint: The file with weights and state.
        step: Optimiser steps taken.
        finished: False where it was interrupted; the same call resumes it.
        validation_loss: The last one measured, None where there was none.
    """

    checkpoint: Path
    step: int
    finished: bool
    validation_loss: float | None


def train_mpnet(
    config: MPNetTrainConfig,
    data: PathSource,
    output: str | Path,
    *,
    validation: PathSource,
    report: Callable[[MPNetProgress], None] | None = None,
) -> MPNetTrainResult:
    """Train MPNet's networks, or go on with a training that was stopped.

    Each step draws maps, and on them pairs of points of a path that a corner separates; the network
    learns to predict the corner from the points. The folder receives ``checkpoint.pt`` and
    ``log.csv``, each replaced as a whole. Where it holds a checkpoint the training goes on from
    there; with a number of steps, on a CPU, it ends with the weights of an uninterrupted one, bit
    by bit. Ctrl-C stops after the current step.

    Args:
        config: Network, limits and optimiser.
        data: Paths of a point robot to learn from.
        output: Folder of the training.
        validation: Paths on other maps.
        report: Called after every step.

    Returns:
        How it ended.

    Raises:
        InvalidDataset: The paths are a car's, or none has a corner.
        InvalidParameter: The device is not usable, or another process trains in the folder.
        InvalidWeights: The folder's checkpoint is damaged.
        WeightsMismatch: It is of another network, other data or other settings.
        TrainingDiverged: The loss or its gradient is infinite or no number; the folder keeps the
            last checkpoint.
    """
    if config.threads is not None:
        torch.set_num_threads(config.threads)
    folder = Path(output)
    with GracefulInterrupt() as interrupt, torch.random.fork_rng(devices=[]), claimed(folder):
        torch.manual_seed(config.seed)
        run = _Run(config, data, validation, folder)
        finished = run.until_done(interrupt, report or (lambda _: None))
    last = run.state.history[-1]["validation_loss"] if run.state.history else None
    return MPNetTrainResult(folder / CHECKPOINT, run.state.step, finished, last)


class _Run:
    """One call of `train_mpnet`."""

    def __init__(
        self, config: MPNetTrainConfig, data: PathSource, validation: PathSource, folder: Path
    ) -> None:
        self.config, self.folder = config, folder
        self.device = usable_device(config.device)
        self.samples = WaypointSamples(data, config.network.scale)
        self.validation = _spread(WaypointSamples(validation, config.network.scale), config)
        self.state = mpnet_state(folder, config, dataclasses.asdict(data.spec), self.device)
        self.began = time.perf_counter() - self.state.seconds

    def until_done(
        self, interrupt: GracefulInterrupt, report: Callable[[MPNetProgress], None]
    ) -> bool:
        """Train up to the limits, True, or until interrupted, False."""
        state, saved = self.state, self.state.seconds
        while not (finished := self._progress() >= 1.0) and not interrupt.requested:
            rate = 0.5 * self.config.learning_rate * (1.0 + math.cos(math.pi * self._progress()))
            loss = self._step(rate)
            state.step += 1
            state.seconds = time.perf_counter() - self.began
            validated = None
            if state.step % self.config.validate_every == 0 or self._progress() >= 1.0:
                validated = self._validate(loss, rate)
            if validated is not None or state.seconds - saved > self.config.checkpoint_seconds:
                state.save(self.folder, self.config)
                saved = state.seconds
            report(MPNetProgress(state.step, state.seconds, rate, loss, validated))
        state.save(self.folder, self.config)
        return finished

    def _progress(self) -> float:
        """The part of the training that is over, from 0 to 1."""
        steps, seconds = self.config.steps, self.config.seconds
        if seconds is not None and self.state.seconds >= seconds:
            return 1.0
        if steps is not None:
            return min(self.state.step / steps, 1.0)
        assert seconds is not None  # checked by the configuration
        return self.state.seconds / seconds

    def _step(self, rate: float) -> float:
        """Take an optimiser step; returns the loss before it."""
        config, optimizer = self.config, self.state.optimizer
        # Random numbers of its own for each step: a resumed training needs no random state.
        rng = np.random.default_rng([config.seed, self.state.step])
        known = self.samples.map_ids
        maps = rng.choice(known, min(config.maps, len(known)), replace=False).tolist()
        batch = self.samples.draw(maps, config.waypoints, rng, augment=config.augment)
        for group in optimizer.param_groups:
            group["lr"] = rate
        optimizer.zero_grad(set_to_none=True)
        loss = self._loss(batch, int(rng.integers(2**63)))
        loss.backward()  # type: ignore[no-untyped-call]
        norm = nn.utils.clip_grad_norm_(self.state.model.parameters(), math.inf)
        if not math.isfinite((value := float(loss.detach())) + float(norm)):
            raise self._diverged(value, rate)
        optimizer.step()
        return value

    def _loss(self, batch: WaypointBatch, seed: int) -> Tensor:
        model, network = self.state.model, self.config.network
        batch = batch.to(self.device)
        noise = torch.rand(
            (len(batch.current), network.units), generator=torch.Generator().manual_seed(seed)
        )
        with torch.autocast(self.device.type, torch.bfloat16, enabled=self.config.bfloat16):
            latents = torch.cat([model.encode(pixels.float()) for pixels in _stacked(batch.maps)])
            latent = latents.repeat_interleave(len(batch.current) // len(batch.maps), dim=0)
            predicted = model(latent, batch.current, batch.goal, noise.to(self.device))
        return F.mse_loss(predicted.float(), batch.target)

    @torch.no_grad()
    def _validate(self, loss: float, rate: float) -> float:
        """Measure the network, with dropout as in planning."""
        state = self.state
        validated = float(np.mean([float(self._loss(batch, 0)) for batch in self.validation]))
        state.record(learning_rate=rate, train_loss=loss, validation_loss=validated)
        return validated

    def _diverged(self, loss: float, rate: float) -> TrainingDiverged:
        step = self.state.step
        return TrainingDiverged(
            f"loss {loss} or its gradient is no finite number after {step} steps, at a learning "
            f"rate of {rate:.3g}: try a smaller learning rate in another folder",
            step=step,
            learning_rate=rate,
        )


def _stacked(maps: list[Tensor]) -> list[Tensor]:
    """Maps of one size at once, others one by one."""
    return [torch.cat(maps)] if len({pixels.shape for pixels in maps}) == 1 else maps


def _spread(samples: WaypointSamples, config: MPNetTrainConfig) -> list[WaypointBatch]:
    """Batches of the validation: the same waypoints each time."""
    count = min(config.validation_maps, len(samples.map_ids))
    places = np.linspace(0, len(samples.map_ids), count, endpoint=False).astype(int)
    maps = [samples.map_ids[place] for place in places]
    rng = np.random.default_rng(0)
    return [
        samples.draw(maps[first : first + config.maps], config.waypoints, rng, augment=False)
        for first in range(0, count, config.maps)
    ]
