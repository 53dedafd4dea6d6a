"""A data set's folder while it is filled: the settings it belongs to, and who fills it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from planformer.data.spec import MANIFEST, DatasetSpec, differences, read_spec, write_spec
from planformer.errors import InvalidDataset
from planformer.files import locked, remove_unfinished


@contextmanager
def claimed(folder: Path, spec: DatasetSpec) -> Iterator[list[str]]:
    """Make a folder this data set's, or check that it is, and keep other processes out.

    Yields:
        File names of the shards that the folder lacks.

    Raises:
        InvalidDataset: The folder holds a data set with other settings or something else, another
            process fills it, or it cannot be written to.
    """
    if folder.exists() and not folder.is_dir():
        raise InvalidDataset(f"{folder} is a file; choose another folder")
    with writing(folder):
        folder.mkdir(parents=True, exist_ok=True)
    with locked(folder, InvalidDataset(f"another process is generating {folder}")):
        _enter_settings(folder, spec)
        remove_unfinished(folder)
        yield [name for name in spec.shards() if not (folder / name).exists()]


@contextmanager
def writing(path: Path) -> Iterator[None]:
    """Turn what the system says about a full or read-only disk into an error that names the file.

    Raises:
        InvalidDataset: The file or folder cannot be written.
    """
    try:
        yield
    except OSError as error:
        raise InvalidDataset(
            f"{path} cannot be written: {error.strerror or error}; finished shards are kept, and "
            "the same settings complete the data set"
        ) from error


def _enter_settings(folder: Path, spec: DatasetSpec) -> None:
    found = read_spec(folder) if (folder / MANIFEST).exists() else None
    if found == spec:
        return
    if found is not None and any((folder / name).exists() for name in found.shards()):
        raise InvalidDataset(
            f"{folder} holds a data set with other settings ({differences(found, spec)}); to "
            "complete it ask for its own settings, for these choose another folder"
        )
    unfinished = set(folder.glob(f".{MANIFEST}.*.tmp"))
    if found is None and set(folder.iterdir()) - unfinished:
        raise InvalidDataset(f"{folder} is neither empty nor a data set; choose another folder")
    with writing(folder / MANIFEST):
        write_spec(folder, spec)
