"""The figures of plans, from plans that are made."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.figure import Figure

from planformer.bench.figures.plans import Drawn
from planformer.bench.guides import PathProposer
from planformer.plotting.layers import draw_path, draw_region
from planformer.plotting.panels import (
    draw_anchors,
    draw_colour_bar,
    draw_headings,
    draw_mask,
    draw_plan,
    draw_scene,
    make_panels,
)

_WIDTH = 13.0
"""Inches of a figure with three panels or more."""


def draw_trees(plans: Sequence[Drawn], *, columns: int) -> Figure:
    """Search trees side by side, with the regions of guided planners."""
    width = _WIDTH * min(columns, 3) / 3
    figure, panels = make_panels([p.known.problem for p in plans], columns=columns, width=width)
    for axes, drawn in zip(panels, plans, strict=True):
        draw_scene(axes, drawn.known.problem, drawn.system, drawn.detail)
        draw_plan(axes, drawn.result)
    return figure


def draw_prediction(plans: Sequence[Drawn]) -> Figure:
    """What the network should select, what it predicts, and what becomes of it, for one plan."""
    (drawn,) = plans
    problem, result = drawn.known.problem, drawn.result
    figure, (truth, prediction, outcome) = make_panels([problem] * 3, columns=3, width=_WIDTH)
    ideal = PathProposer(drawn.known.reference).propose(problem)
    draw_scene(truth, problem, "Truth", "the expert's path, anchors within 0.7 m of it")
    draw_region(truth, problem.grid, ideal)
    draw_anchors(truth, ideal)
    draw_path(truth, problem.robot, drawn.known.reference)
    draw_scene(prediction, problem, "Prediction", "probability of each anchor", heat=result.region)
    draw_colour_bar(prediction)
    draw_scene(outcome, problem, f"Masked map and {drawn.system}", drawn.detail)
    draw_mask(outcome, problem, result.region)
    if result.solved:
        draw_path(outcome, problem.robot, result.path)
    return figure


def draw_sizes(plans: Sequence[Drawn]) -> Figure:
    """Paths on maps of several sizes, at one scale."""
    problems = [drawn.known.problem for drawn in plans]
    figure, panels = make_panels(problems, columns=2, width=_WIDTH)
    for axes, drawn in zip(panels, plans, strict=True):
        problem = drawn.known.problem
        rows, columns = problem.grid.shape
        draw_scene(axes, problem, f"{columns} x {rows}", drawn.detail, heat=drawn.result.region)
        draw_region(axes, problem.grid, drawn.result.region)
        if drawn.result.solved:
            draw_path(axes, problem.robot, drawn.result.path)
    return figure


def draw_cars(plans: Sequence[Drawn]) -> Figure:
    """Paths of a car, with the ellipses and headings that its samples come from."""
    problems = [drawn.known.problem for drawn in plans]
    figure, panels = make_panels(problems, columns=len(plans), width=_WIDTH)
    for axes, drawn in zip(panels, plans, strict=True):
        draw_scene(axes, drawn.known.problem, drawn.system, drawn.detail)
        draw_headings(axes, drawn.result.region)
        if drawn.result.solved:
            draw_path(axes, drawn.known.problem.robot, drawn.result.path)
    return figure
