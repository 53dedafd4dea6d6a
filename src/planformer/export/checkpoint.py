"""Export of a checkpoint, whatever network it holds."""

from __future__ import annotations

import pickle
from pathlib import Path

import torch

from planformer.export.mpnet import export_mpnet
from planformer.export.next_ks import export_next
from planformer.export.onnx import Exported, export


def export_checkpoint(
    checkpoint: str | Path, path: str | Path, *, name: str | None = None
) -> Exported:
    """Export a region proposer, MPNet or NEXT-KS; arguments and errors as those of `export`."""
    exports = {"mpnet": export_mpnet, "next": export_next}
    return exports.get(_architecture(Path(checkpoint)), export)(checkpoint, path, name=name)


def _architecture(path: Path) -> str:
    """What a checkpoint's configuration is of; nothing for a region proposer or a damaged file."""
    try:
        config = torch.load(path, map_location="cpu", weights_only=True, mmap=True)["config"]
        return str(config.get("architecture", ""))
    except (AttributeError, EOFError, KeyError, OSError, RuntimeError, TypeError, ValueError):
        return ""
    except pickle.UnpicklingError:
        return ""
