"""Reading map files: every failure names the file."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterator
from pathlib import Path

from planformer.errors import InvalidMap

PathLike = str | os.PathLike[str]


def read_bytes(path: Path) -> bytes:
    """The content of a file.

    Raises:
        InvalidMap: The file does not exist, is a directory or cannot be read; see `naming`.
    """
    try:
        return path.read_bytes()
    except (OSError, ValueError) as error:  # ValueError: a NUL in the name
        reason = getattr(error, "strerror", None) or error
        raise InvalidMap(f"cannot be read: {reason}") from error


@contextlib.contextmanager
def naming(path: Path) -> Iterator[None]:
    """Put the file's name before the reason of any `InvalidMap` raised inside."""
    try:
        yield
    except InvalidMap as error:
        raise InvalidMap(f"{path}: {error}") from error
