"""Pictures of plans, trainings and benchmarks, drawn with Matplotlib."""

from planformer.plotting.curves import plot_training
from planformer.plotting.result import plot_result
from planformer.plotting.save import save_picture
from planformer.plotting.statistics import plot_letter_values, plot_solved

__all__ = ["plot_letter_values", "plot_result", "plot_solved", "plot_training", "save_picture"]
