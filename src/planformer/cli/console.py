"""Where the command line prints: results to stdout, everything else to stderr."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Mapping
from typing import Any

from rich.console import Console
from rich.text import Text


class _Console(Console):
    """A console that lets a broken pipe be seen; Rich's own would exit with status 1."""

    def on_broken_pipe(self) -> None:
        raise BrokenPipeError


stdout = _Console(highlight=False)
stderr = _Console(stderr=True, highlight=False)


def report(message: str, *, kind: str = "error: ") -> None:
    """Print one red line to stderr, never wrapped."""
    line = " ".join(message.split())
    stderr.print(Text.assemble((kind, "bold red"), (line, "red")), soft_wrap=True)


def print_json(record: Mapping[str, Any]) -> None:
    """Print a record to stdout as JSON; numbers that JSON cannot express are an error."""
    print(to_json(record), end="", flush=True)


def to_json(record: Mapping[str, Any]) -> str:
    """JSON text of a record, ending in a newline."""
    return json.dumps(record, indent=2, allow_nan=False, ensure_ascii=False) + "\n"


def print_facts(title: Text | str, facts: Mapping[str, str]) -> None:
    """Print a title and a name and value a line; values are never wrapped or cut."""
    stdout.print(title, soft_wrap=True)
    width = max(map(len, facts), default=0)
    for name, value in facts.items():
        first, *rest = value.splitlines() or [""]
        line = Text.assemble("  ", (name.ljust(width), "dim"), "  ", first)
        stdout.print(line, soft_wrap=True)
        for more in rest:
            stdout.print(Text(" " * (width + 4) + more), soft_wrap=True)


def give_up_stdout() -> None:
    """Let nothing more reach a closed stdout: its last flush would fail when Python ends."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
