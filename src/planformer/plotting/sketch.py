"""A small picture without words, for where the facts stand beside it."""

from __future__ import annotations

from matplotlib.figure import Figure

from planformer.guidance import Region
from planformer.planning import PlanResult, Problem
from planformer.plotting.layers import draw_ends, draw_map, draw_region, draw_result
from planformer.plotting.view import make_view

DPI = 115
_WIDTH = 5.0
"""Inches across."""
_MAX_HEIGHT = 7.5


def sketch(problem: Problem, *, region: Region | None, result: PlanResult | None) -> Figure:
    """Draw a problem with what was found for it, filling the picture.

    Args:
        problem: The problem.
        region: Its region, drawn with the probabilities.
        result: Its plan.
    """
    view = make_view(problem.grid, [problem.start[:2], problem.goal[:2]])
    low, high = view.world_bounds()
    height = min(_WIDTH * (high[1] - low[1]) / (high[0] - low[0]), _MAX_HEIGHT)
    figure = Figure(figsize=(_WIDTH, height), dpi=DPI, facecolor="white")
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set_axis_off()
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), autoscale_on=False)
    draw_map(axes, view, problem.robot.radius, region, pixels=int(max(_WIDTH, height) * DPI))
    if result is not None:
        draw_result(axes, result)
    elif region is not None:
        draw_region(axes, problem.grid, region)
    draw_ends(axes, problem)
    return figure
