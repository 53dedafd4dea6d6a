"""Export of trained networks for ONNX Runtime."""

import planformer.models  # noqa: F401  # says how to install PyTorch where it is missing
from planformer.export.checkpoint import export_checkpoint
from planformer.export.onnx import Exported, export

__all__ = ["Exported", "export", "export_checkpoint"]
