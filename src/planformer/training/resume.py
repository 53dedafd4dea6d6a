"""Whether a training may go on from a checkpoint."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
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
"""Settings that do not say what a learned planner's training learns."""


def require_same_training(
    path: Path, stored: Mapping[str, Any], settings: Mapping[str, Any], data: Mapping[str, Any]
) -> None:
    """Refuse a checkpoint of a learned planner whose training would become another one.

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
        what = f"{path} is of another training"
        raise mismatch(what, differing, theirs, ours, "choose another folder")


def mismatch(
    what: str,
    names: Sequence[str],
    theirs: Mapping[str, Any],
    ours: Mapping[str, Any],
    remedy: str,
) -> WeightsMismatch:
    """The error for values that are others, with both sides of what differs.

    Args:
        what: What is refused.
        names: The names that differ; none where the two name nothing in common.
        theirs: The values that were found, by name.
        ours: The values asked for.
        remedy: What to do instead.
    """
    there, here = (
        ", ".join(f"{name} {values.get(name)!r:.80}" for name in names or values)
        for values in (theirs, ours)
    )
    return WeightsMismatch(f"{what}: {there}; asked for {here}: {remedy}")
