"""Files that appear whole or not at all."""

from __future__ import annotations

import errno
import fcntl
import os
import re
import secrets
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import BinaryIO

from planformer.errors import InvalidParameter, PlanformerError

_UNFINISHED = re.compile(r"\..+\.(\d+)-[0-9a-f]+\.tmp")
"""Name of a file that a process is writing, with the process's number."""


def make_folder(folder: Path, error: type[PlanformerError] = InvalidParameter) -> None:
    """Make a folder and its parents where they are missing.

    Raises:
        PlanformerError: They cannot be made; of the class that is given.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as reason:
        raise error(f"{folder}: cannot be made: {reason.strerror or reason}") from reason


@contextmanager
def whole_file(path: Path) -> Iterator[BinaryIO]:
    """Open a file for writing that takes its name only when the block ends without an error.

    The content goes to a file of another name in the same folder, which is renamed at the end
    and removed when the block raises, also on Ctrl-C.
    """
    temporary = _temporary(path)
    try:
        with _on_disk(temporary) as file:
            yield file
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)


def remove_unfinished(folder: Path) -> None:
    """Remove what processes that were killed have left in a folder of files they were writing."""
    for file in folder.glob(".*.tmp"):
        unfinished = _UNFINISHED.fullmatch(file.name)
        if unfinished and not _runs(int(unfinished[1])):
            file.unlink(missing_ok=True)


@contextmanager
def locked(folder: Path, refusal: Exception) -> Iterator[None]:
    """Hold a lock on a folder that the system releases however this process ends.

    Args:
        folder: The folder.
        refusal: Raised where another process holds the lock.
    """
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise refusal from None
        except OSError:
            pass  # a file system without locks; files appear whole all the same
        yield
    finally:
        os.close(descriptor)


def write_files(contents: Mapping[Path, bytes]) -> None:
    """Write several files; none is replaced before the contents of all are on the disk.

    They are replaced in their order, so one that names the others comes last.

    Raises:
        InvalidParameter: A file cannot be written.
    """
    try:
        with ExitStack() as stack:
            temporaries = {path: _temporary(path) for path in contents}
            for path, temporary in temporaries.items():
                if path.is_dir():
                    raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
                stack.callback(temporary.unlink, missing_ok=True)
                with _on_disk(temporary) as file:
                    file.write(contents[path])
            for path, temporary in temporaries.items():
                temporary.replace(path)
    except OSError as error:
        names = ", ".join(map(str, contents))
        raise InvalidParameter(f"{names}: cannot be written: {error.strerror or error}") from error


def _temporary(path: Path) -> Path:
    """A name for the file of a path that no other thread or process takes."""
    return path.with_name(f".{path.name}.{os.getpid()}-{secrets.token_hex(4)}.tmp")


@contextmanager
def _on_disk(path: Path) -> Iterator[BinaryIO]:
    """Open a file for writing whose content is on the disk when the block ends."""
    with path.open("wb") as file:
        yield file
        file.flush()
        os.fsync(file.fileno())  # a rename that outlives a power cut must not outrun the data


def _runs(process: int) -> bool:
    try:
        os.kill(process, 0)
    except (ProcessLookupError, OverflowError):
        return False
    except PermissionError:  # it is another user's
        pass
    return True
