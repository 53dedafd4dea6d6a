"""What a learned planner's training may change when it goes on from a checkpoint."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from planformer.errors import WeightsMismatch

_MAY_CHANGE = {
    "bfloat16",
    "checkpoint_seconds",
    "device",
    "seconds",
    "steps",
    "threads",
    "validate_every",
    "validation_maps",
    "validation_problems",
}
"""Settings that do not say what it learns."""


def require_same_training(
    path: Path, stored: Mapping[str, Any], settings: Mapping[str, Any], data: Mapping[str, Any]
) -> None:
    """Refuse a checkpoint whose training would become another one.

    Args:
        path: The checkpoint.
        stored: Its content.
        settings: The training's settings.
        data: What describes its data.

    Raises:
        WeightsMismatch: The settings or the data are others.
    """
    theirs = {"data": stored["data"], **stored["training"]}
    ours = {"data": data, **settings}
    differing = [n for n in ours if n not in _MAY_CHANGE and theirs.get(n) != ours[n]]
    if differing:
        there, here = (
            ", ".join(f"{name} {values.get(name)!r:.80}" for name in differing)
            for values in (theirs, ours)
        )
        raise WeightsMismatch(
            f"{path} is of another training: {there}; asked for {here}: choose another folder"
        )
