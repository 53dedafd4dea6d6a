"""Pictures as files."""

from __future__ import annotations

import io
import os
from pathlib import Path

from matplotlib.figure import Figure

from planformer.errors import InvalidParameter
from planformer.files import write_files

_FORMATS = ("png", "pdf", "svg", "jpg")


def save_picture(figure: Figure, path: str | os.PathLike[str]) -> None:
    """Save a figure; the suffix (.png, .pdf, .svg or .jpg) says the format.

    The file appears whole or not at all.

    Args:
        figure: From `plot_result`.
        path: The file to write.

    Raises:
        InvalidParameter: The suffix is unknown or the file cannot be written.
    """
    file = Path(path)
    kind = file.suffix.lower().lstrip(".")
    if kind not in _FORMATS:
        valid = ", ".join(f".{name}" for name in _FORMATS)
        raise InvalidParameter(f"{file}: a picture's suffix must be one of {valid}")
    write_files({file: encoded(figure, kind)})


def encoded(figure: Figure, kind: str) -> bytes:
    """The bytes of a figure's file of a kind ("png", "pdf", ...)."""
    buffer = io.BytesIO()
    figure.savefig(buffer, format=kind)
    return buffer.getvalue()
