"""`planformer train` for the planners that bring a network of their own."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from planformer.cli.console import print_facts, print_json, stderr
from planformer.cli.exit_codes import INTERRUPTED
from planformer.errors import InvalidParameter

if TYPE_CHECKING:
    from planformer.training.sources import PathSource

BASELINES = ("mpnet", "next-ks")


def require_none(preset: str, options: Mapping[str, Any]) -> None:
    """Refuse options that a baseline's training does not have.

    Raises:
        InvalidParameter: One is given.
    """
    if unknown := [f"--{name.replace('_', '-')}" for name, v in options.items() if v is not None]:
        raise InvalidParameter(f"the preset {preset} does not take {', '.join(unknown)}")


def train_baseline(
    preset: str,
    problems: PathSource,
    validation: PathSource,
    output: Path,
    given: Mapping[str, Any],
    *,
    as_json: bool,
) -> None:
    """Train MPNet's or NEXT-KS's network and print how it ended.

    Args:
        preset: A name in `BASELINES`.
        problems: Problems to learn from.
        validation: Problems on other maps.
        output: Folder of the training.
        given: Settings by name; those that are None keep their defaults.
        as_json: Print JSON and nothing else.

    Raises:
        Exit: The training was interrupted.
    """
    from planformer.training.mpnet import train_mpnet
    from planformer.training.mpnet_config import MPNetTrainConfig
    from planformer.training.next_ks import train_next
    from planformer.training.next_ks_config import NextTrainConfig

    settings = {name: value for name, value in given.items() if value is not None}
    result: Any
    with stderr.status("preparing") as status:

        def show(progress: Any) -> None:
            status.update(f"step {progress.step}  loss {progress.loss:.4f}")
            if words := _validation_words(asdict(progress)):
                stderr.print(f"step {progress.step}  {words}", soft_wrap=True)

        if preset == "mpnet":
            result = train_mpnet(
                MPNetTrainConfig(**settings), problems, output, validation=validation, report=show
            )
        else:
            result = train_next(
                NextTrainConfig(**settings), problems, output, validation=validation, report=show
            )
    facts = {**asdict(result), "checkpoint": str(result.checkpoint)}
    if as_json:
        print_json(facts)
    else:
        title = "training finished" if result.finished else "interrupted; the same command goes on"
        print_facts(title, {name: str(v) for name, v in facts.items() if v is not None})
    if not result.finished:
        raise typer.Exit(INTERRUPTED)


def _validation_words(progress: Mapping[str, Any]) -> str:
    measured = progress.get("metrics", {"loss": progress.get("validation_loss")})
    shown = {name: value for name, value in (measured or {}).items() if value is not None}
    return "  ".join(f"validation {name} {value:.4g}" for name, value in shown.items())
