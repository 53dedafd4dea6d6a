"""The files in a training's folder."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from planformer.files import whole_file

CHECKPOINT = "checkpoint.pt"
LOG = "log.csv"


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
