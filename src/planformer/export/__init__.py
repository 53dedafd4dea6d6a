"""Export of trained networks for ONNX Runtime."""

from planformer.export.onnx import Exported, export

__all__ = ["Exported", "export"]
