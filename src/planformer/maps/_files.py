"""Reading and writing map files: every failure names the file, nothing is written half."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterator, Mapping
from pathlib import Path

from planformer.errors import InvalidMap, InvalidParameter

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


def write_files(contents: Mapping[Path, bytes]) -> None:
    """Write files under temporary names, then rename all: an error leaves the old ones as they are.

    Raises:
        InvalidParameter: A file cannot be written.
    """
    temporary = {path.with_name(f".{path.name}.{os.getpid()}.tmp"): path for path in contents}
    try:
        for name, path in temporary.items():
            name.write_bytes(contents[path])
        for name, path in temporary.items():
            name.replace(path)
    except OSError as error:
        names = ", ".join(map(str, contents))
        raise InvalidParameter(f"{names}: cannot be written: {error.strerror or error}") from error
    finally:
        for name in temporary:
            with contextlib.suppress(OSError):
                name.unlink()


@contextlib.contextmanager
def naming(path: Path) -> Iterator[None]:
    """Put the file's name before the reason of any `InvalidMap` raised inside."""
    try:
        yield
    except InvalidMap as error:
        raise InvalidMap(f"{path}: {error}") from error
