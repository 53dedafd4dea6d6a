"""Figures of plans on fixed problems, planned anew: trees, a prediction, map sizes, cars."""

from planformer.bench.figures.write import FIGURES, write_plan_figures

__all__ = ["FIGURES", "write_plan_figures"]
