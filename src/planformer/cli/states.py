"""Options that take a state, X Y or X Y YAW: something that Typer alone cannot parse."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

import typer
from typer.core import TyperCommand

STATE_OPTIONS = ("--start", "--goal")
METAVAR = "X Y [YAW]"


class StateCommand(TyperCommand):
    """A command whose state options take all numbers that follow them, also negative ones."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        """Join the numbers of each state, then parse as any command does."""
        return super().parse_args(ctx, join_states(args))


def join_states(args: Sequence[str]) -> list[str]:
    """Turn ``--start 1 -2 0.5`` into ``--start=1 -2 0.5``, one argument.

    Numbers may be separated by spaces or commas; nothing changes behind ``--``.
    """
    joined: list[str] = []
    is_open = False
    for at, arg in enumerate(args):
        if arg == "--":
            return [*joined, *args[at:]]
        if is_open and _is_numeric(arg):
            joined[-1] += f"{arg} "
            continue
        name, given, value = arg.partition("=")
        is_open = name in STATE_OPTIONS
        joined.append(f"{name}={value + ' ' if given else ''}" if is_open else arg)
    return joined


def parse_state(text: str, option: str) -> tuple[float, ...]:
    """The numbers of a state.

    Raises:
        typer.BadParameter: They are not two or three numbers.
    """
    words = _words(text)
    if not (words and _is_numeric(text) and 2 <= len(words) <= 3):
        given = f"{text.strip()!r}" if text.strip() else "nothing"
        raise typer.BadParameter(
            f"expected {METAVAR} in metres and radians, such as {option} 1.0 -2.0; got {given}",
            param_hint=option,
        )
    return tuple(map(float, words))


def _words(text: str) -> list[str]:
    return [word for word in re.split(r"[,\s]+", text) if word]


def _is_numeric(text: str) -> bool:
    """Whether a text is numbers and nothing else."""
    try:
        return len([float(word) for word in _words(text)]) > 0
    except ValueError:
        return False
