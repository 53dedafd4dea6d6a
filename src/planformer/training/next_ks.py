"""The training of NEXT's network: first from experts' paths, then from its own searches too."""

from __future__ import annotations

import dataclasses
import math
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import torch
from torch import Tensor, nn, optim

from planformer.baselines.next_ks import DEVIATION
from planformer.errors import (
    InvalidDataset,
    InvalidWeights,
    TrainingDiverged,
    WeightsMismatch,
)
from planformer.models.next_ks import NextNetwork
from planformer.models.storage import load_next, save_planner
from planformer.training.augmentation import augment
from planformer.training.devices import usable_device
from planformer.training.folder import CHECKPOINT, claimed, write_log
from planformer.training.interrupt import GracefulInterrupt
from planformer.training.next_ks_config import NextTrainConfig
from planformer.training.next_ks_samples import Lessons, make_lessons, searched_paths
from planformer.training.resume import require_same_training
from planformer.training.sources import PathSource, load_example

_METRICS = ("loss", "step_error", "value_error")
_MAX_GRADIENT_NORM = 1.0
_EXPLORATION = (1.0, 0.1)
"""Probability of RRT's samples in the first third of the searches, and at their end."""


@dataclass(frozen=True)
class NextProgress:
    """What a step of the training reports.

    Attributes:
        step: Optimiser steps taken so far.
        seconds: Training time so far, over all resumptions.
        learning_rate: Learning rate of the step.
        loss: Loss of the step.
        metrics: ``loss``, ``step_error`` [steps] and ``value_error`` on the validation problems;
            None where they were not measured.
    """

    step: int
    seconds: float
    learning_rate: float
    loss: float
    metrics: dict[str, float] | None


@dataclass(frozen=True)
class NextTrainResult:
    """How a training ended.

    Attributes:
        checkpoint: The file with weights and state.
        step: Optimiser steps taken.
        finished: False where it was interrupted; the same call resumes it.
        metrics: The last validation; empty where there was none.
    """

    checkpoint: Path
    step: int
    finished: bool
    metrics: dict[str, float]


def train_next(
    config: NextTrainConfig,
    data: PathSource,
    output: str | Path,
    *,
    validation: PathSource,
    report: Callable[[NextProgress], None] | None = None,
) -> NextTrainResult:
    """Train NEXT's network, or go on with a training that was stopped.

    The loss is that of the paper: minus the log-likelihood of the path's next step, and the squared
    error of the value. The folder receives ``checkpoint.pt`` and ``log.csv``, each replaced as a
    whole. Where it holds a checkpoint the training goes on from there; with a number of steps, on a
    CPU, it ends with the weights of an uninterrupted one, bit by bit. Ctrl-C stops after the
    current step.

    Args:
        config: Network, limits and optimiser.
        data: Paths of a point robot to learn from.
        output: Folder of the training.
        validation: Paths on other maps.
        report: Called after every step.

    Returns:
        How it ended.

    Raises:
        InvalidDataset: The paths are a car's, or fewer than a step needs.
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
    return NextTrainResult(folder / CHECKPOINT, run.state.step, finished, run.metrics)


def exploration(progress: float) -> float:
    """The share of RRT's samples in a search, by the part of the searches that is over."""
    first, last = _EXPLORATION
    return first + (last - first) * max(0.0, 1.5 * progress - 0.5)


@dataclass
class _State:
    """A network in training.

    Attributes:
        model: The network.
        optimizer: Its optimiser.
        step: Optimiser steps taken.
        seconds: Time spent, over all resumptions.
        history: One row for each validation.
    """

    model: NextNetwork
    optimizer: optim.Optimizer
    step: int = 0
    seconds: float = 0.0
    history: list[dict[str, float]] = field(default_factory=list)


class _Run:
    """One call of `train_next`."""

    def __init__(
        self, config: NextTrainConfig, data: PathSource, validation: PathSource, folder: Path
    ) -> None:
        _check_fits(data, config.problems)
        _check_fits(validation, 1)
        self.config, self.data, self.folder = config, data, folder
        self.device = usable_device(config.device)
        self.description = dataclasses.asdict(data.spec)
        self.validation = _validation_lessons(validation, config)
        self.state = self._state()
        self.began = time.perf_counter() - self.state.seconds
        self.metrics = {name: row[name] for row in self.state.history[-1:] for name in _METRICS}

    def until_done(
        self, interrupt: GracefulInterrupt, report: Callable[[NextProgress], None]
    ) -> bool:
        """Train up to the limits, True, or until interrupted, False."""
        state, saved = self.state, self.state.seconds
        while not (finished := self._progress() >= 1.0) and not interrupt.requested:
            rate = 0.5 * self.config.learning_rate * (1.0 + math.cos(math.pi * self._progress()))
            loss = self._step(self._lessons(), rate)
            state.step += 1
            state.seconds = time.perf_counter() - self.began
            metrics = None
            if state.step % self.config.validate_every == 0 or self._progress() >= 1.0:
                metrics = self._validate(loss, rate)
            if metrics is not None or state.seconds - saved > self.config.checkpoint_seconds:
                self._save()
                saved = state.seconds
            report(NextProgress(state.step, state.seconds, rate, loss, metrics))
        self._save()
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

    def _lessons(self) -> Lessons:
        """The problems of a step, the first of them with the network's own searches."""
        config = self.config
        # Random numbers of its own for each step: a resumed training needs no random state.
        rng = np.random.default_rng([config.seed, self.state.step])
        indices = rng.choice(len(self.data), config.problems, replace=False)
        examples = [load_example(self.data, int(index)) for index in indices]
        if config.augment:
            examples = [augment(example, rng) for example in examples]
        paths = [[example.path] for example in examples]
        searching = (self._progress() - config.imitation) / max(1.0 - config.imitation, 1e-9)
        if searching >= 0.0:
            epsilon = exploration(searching)
            self.state.model.eval()
            for place in range(config.searches):
                paths[place] = searched_paths(
                    self.state.model,
                    examples[place],
                    epsilon,
                    config.samples,
                    int(rng.integers(2**32)),
                )
        return make_lessons(examples, paths, config.network.side, config.states, rng)

    def _step(self, lessons: Lessons, rate: float) -> float:
        """Take an optimiser step; returns the loss before it."""
        model, optimizer = self.state.model, self.state.optimizer
        model.train()
        for group in optimizer.param_groups:
            group["lr"] = rate
        step_error, value_error = self._errors(lessons)
        loss = _loss(step_error, value_error)
        optimizer.zero_grad(set_to_none=True)
        loss.backward()  # type: ignore[no-untyped-call]
        norm = nn.utils.clip_grad_norm_(model.parameters(), _MAX_GRADIENT_NORM)
        if not math.isfinite((value := float(loss.detach())) + float(norm)):
            raise self._diverged(value, rate)
        optimizer.step()
        return value

    def _errors(self, lessons: Lessons) -> tuple[Tensor, Tensor]:
        """Mean squared errors of the next step, in lengths of a step, and of the value."""
        model, lessons = self.state.model, lessons.to(self.device)
        with torch.autocast(self.device.type, torch.bfloat16, enabled=self.config.bfloat16):
            context = model.plan(lessons.free, lessons.goal)
            mean, value = model.evaluate(context, lessons.states)
        step_error = (mean - lessons.steps).square().sum(-1).mean()
        return step_error, (value - lessons.values).square().mean()

    @torch.no_grad()
    def _validate(self, loss: float, rate: float) -> dict[str, float]:
        state = self.state
        state.model.eval()
        errors = [self._errors(lessons) for lessons in self.validation]
        step_error, value_error = (torch.stack(part).mean() for part in zip(*errors, strict=True))
        self.metrics = {
            "loss": float(_loss(step_error, value_error)),
            "step_error": float(step_error.sqrt()),
            "value_error": float(value_error.sqrt()),
        }
        common = {"step": state.step, "seconds": round(state.seconds, 1), "learning_rate": rate}
        state.history.append({**common, "train_loss": loss, **self.metrics})
        return self.metrics

    def _diverged(self, loss: float, rate: float) -> TrainingDiverged:
        step = self.state.step
        return TrainingDiverged(
            f"loss {loss} or its gradient is no finite number after {step} steps, at a learning "
            f"rate of {rate:.3g}: try a smaller learning rate in another folder",
            step=step,
            learning_rate=rate,
        )

    def _state(self) -> _State:
        path, config = self.folder / CHECKPOINT, self.config
        model, stored = load_next(path) if path.exists() else (NextNetwork(config.network), None)
        model = model.to(self.device)
        optimizer = optim.Adam(model.parameters(), weight_decay=config.weight_decay)
        if stored is None:
            return _State(model, optimizer)
        try:
            require_same_training(path, stored, self.config.to_dict(), self.description)
            optimizer.load_state_dict(stored["optimizer"])
            return _State(
                model, optimizer, **{name: stored[name] for name in ("step", "seconds", "history")}
            )
        except WeightsMismatch:
            raise
        except (AttributeError, KeyError, TypeError, ValueError) as error:
            raise InvalidWeights(f"{path} is no checkpoint of a training: {error!r}") from error

    def _save(self) -> None:
        state = self.state
        save_planner(
            self.folder / CHECKPOINT,
            state.model,
            optimizer=state.optimizer.state_dict(),
            training=self.config.to_dict(),
            data=self.description,
            step=state.step,
            seconds=state.seconds,
            history=state.history,
        )
        write_log(self.folder, state.history)


def _loss(step_error: Tensor, value_error: Tensor) -> Tensor:
    """Minus the log-likelihood of the next step, less a constant, and the value's error."""
    return step_error / (2.0 * DEVIATION**2) + value_error


def _check_fits(source: PathSource, least: int) -> None:
    if len(source) < least:
        raise InvalidDataset(f"{least} problems are needed; the data set has {len(source)}")
    if source[0].path.shape[1] != 2:
        raise InvalidDataset("NEXT plans for a point robot; the data set is of a car")


def _validation_lessons(source: PathSource, config: NextTrainConfig) -> list[Lessons]:
    """The same states each time."""
    count = min(config.validation_problems, len(source))
    places = np.linspace(0, len(source), count, endpoint=False).astype(int)
    examples = [load_example(source, int(place)) for place in places]
    rng = np.random.default_rng(0)
    batches = [examples[i : i + config.problems] for i in range(0, count, config.problems)]
    return [
        make_lessons(batch, [[e.path] for e in batch], config.network.side, config.states, rng)
        for batch in batches
    ]
