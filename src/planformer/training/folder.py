"""The files in a training's folder."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from planformer.errors import InvalidParameter
from planformer.files import locked, make_folder, remove_unfinished, whole_file

CHECKPOINT = "checkpoint.pt"
LOG = "log.csv"


@contextmanager
def claimed(folder: Path) -> Iterator[None]:
    """Make a training's folder and keep other processes out of it.

    Raises:
        InvalidParameter: It cannot be made, or another process trains there.
    """
    make_folder(folder)
    with locked(folder, InvalidParameter(f"another process trains in {folder}")):
        remove_unfinished(folder)
        yield


def write_log(folder: Path, rows: Sequence[Mapping[str, Any]]) -> None:
    """Replace a training's ``log.csv``; without rows there is none.

    Args:
        folder: Folder of the training.
        rows: Measures by name, the same names in each.
    """
    if not rows:
        return
    text = io.StringIO()
    writer = csv.DictWriter(text, fieldnames=list(rows[0]), lineterminator="\n")
    writer.writeheader()
    writer.writerows(
        {k: f"{v:.6g}" if isinstance(v, float) else v for k, v in row.items()} for row in rows
    )
    with whole_file(folder / LOG) as file:
        file.write(text.getvalue().encode())
