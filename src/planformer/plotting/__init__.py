"""Pictures of plans and trainings, drawn with Matplotlib."""

from planformer.plotting.curves import plot_training
from planformer.plotting.result import plot_result
from planformer.plotting.save import save_picture

__all__ = ["plot_result", "plot_training", "save_picture"]
