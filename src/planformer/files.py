"""Files that appear whole or not at all."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import BinaryIO

from planformer.errors import InvalidParameter


@contextmanager
def whole_file(path: Path) -> Iterator[BinaryIO]:
    """Open a file for writing that takes its name only when the block ends without an error.

    The content goes to a file of another name in the same folder, which is renamed at the end
    and removed when the block raises, also on Ctrl-C.
    """
    temporary = path.with_name(f".{path.name}.{os.getpid()}.tmp")
    try:
        with temporary.open("wb") as file:
            yield file
            file.flush()
            os.fsync(file.fileno())  # a rename that outlives a power cut must not outrun the data
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)


def remove_unfinished(folder: Path) -> None:
    """Remove what processes that were killed have left of files that they were writing."""
    for leftover in folder.glob(".*.tmp"):
        leftover.unlink(missing_ok=True)


def write_files(contents: Mapping[Path, bytes]) -> None:
    """Write several files; none is replaced before all have been written.

    Raises:
        InvalidParameter: A file cannot be written.
    """
    try:
        with ExitStack() as stack:
            for path, content in contents.items():
                stack.enter_context(whole_file(path)).write(content)
    except OSError as error:
        names = ", ".join(map(str, contents))
        raise InvalidParameter(f"{names}: cannot be written: {error.strerror or error}") from error
