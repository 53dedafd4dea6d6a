"""Optimisers and learning rates of the two recipes."""

from __future__ import annotations

import math

from torch import nn, optim

from planformer.training.config import Recipe, TrainConfig

_PAPER_WIDTH = 256
"""The d of the paper's learning rate; its published experiments used 256, not the network's."""
_FLOOR = 0.02
"""Final learning rate of the cosine schedule over its peak."""


def create_optimizer(model: nn.Module, config: TrainConfig) -> optim.Optimizer:
    """Adam as in the paper, or AdamW without decay of biases and norms."""
    if config.recipe is Recipe.PAPER:
        return optim.Adam(model.parameters(), betas=(0.9, 0.98), eps=1e-9)
    parameters = list(model.parameters())
    groups = [
        {"params": [p for p in parameters if p.ndim > 1], "weight_decay": config.weight_decay},
        {"params": [p for p in parameters if p.ndim <= 1], "weight_decay": 0.0},
    ]
    return optim.AdamW(groups, lr=config.learning_rate, betas=(0.9, 0.98))


def learning_rate(config: TrainConfig, *, step: int, seconds: float) -> float:
    """Learning rate of a step.

    Args:
        config: Recipe, peak and limits.
        step: Steps taken so far.
        seconds: Training time so far.
    """
    warmup = float(max(config.warmup_steps, 1))
    if config.recipe is Recipe.PAPER:
        number = float(step + 1)
        rise, fall = number / (warmup * math.sqrt(warmup)), 1 / math.sqrt(number)
        return 0.5 / math.sqrt(_PAPER_WIDTH) * min(rise, fall)
    progress = min(_progress(config, step, seconds), 1.0)
    cosine = _FLOOR + (1 - _FLOOR) * 0.5 * (1 + math.cos(math.pi * progress))
    return config.learning_rate * min((step + 1) / warmup, 1.0) * cosine


def _progress(config: TrainConfig, step: int, seconds: float) -> float:
    if config.steps is not None:
        return step / config.steps
    assert config.seconds is not None  # checked by TrainConfig
    return seconds / config.seconds
