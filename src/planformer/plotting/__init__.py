"""Pictures of plans, drawn with Matplotlib."""

from planformer.plotting.result import plot_result
from planformer.plotting.save import save_picture

__all__ = ["plot_result", "save_picture"]
