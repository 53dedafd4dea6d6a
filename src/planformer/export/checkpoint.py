"""Export of a checkpoint, whatever network it holds."""

from __future__ import annotations

from pathlib import Path

from planformer.export.mpnet import export_mpnet
from planformer.export.next_ks import export_next
from planformer.export.onnx import Exported, export
from planformer.models.storage import architecture_of

_EXPORTS = {"mpnet": export_mpnet, "next": export_next}


def export_checkpoint(
    checkpoint: str | Path, path: str | Path, *, name: str | None = None
) -> Exported:
    """Export a region proposer, MPNet or NEXT-KS; arguments and errors as those of `export`."""
    return _EXPORTS.get(architecture_of(Path(checkpoint)), export)(checkpoint, path, name=name)
