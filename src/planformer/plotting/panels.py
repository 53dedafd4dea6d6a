"""Maps side by side at one scale, and what only figures of several panels draw."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import EllipseCollection, LineCollection
from matplotlib.colors import to_rgba
from matplotlib.figure import Figure
from matplotlib.transforms import Affine2D

from planformer.errors import InvalidResults
from planformer.guidance import Region
from planformer.planning import PlanResult, Problem
from planformer.planning.sampling import ELLIPSE_ASPECT
from planformer.plotting import style
from planformer.plotting.annotations import fill_colour_bar, nice_length
from planformer.plotting.layers import draw_ends, draw_map, draw_result
from planformer.plotting.view import make_view

DPI = 110
_GAP, _HEADER, _FOOTER = 0.18, 0.62, 0.42
"""Inches beside a panel, above it for its title, and below the lowest row."""
_VERTEX = 3.2
"""Points across a vertex of a tree."""
_MASK_OPACITY = 0.72
_TICK = 0.7
"""Length of a heading's stroke as a share of the ellipse's half length."""


def make_panels(
    problems: Sequence[Problem], *, columns: int, width: float
) -> tuple[Figure, list[Axes]]:
    """Lay out a panel for each problem, all maps at one scale, with a scale bar.

    Args:
        problems: The problems, row by row.
        columns: Panels in a row.
        width: Width of the figure in inches.

    Returns:
        The figure and the axes, in metres, with nothing drawn on them.

    Raises:
        InvalidResults: There is no problem.
    """
    if not problems:
        raise InvalidResults("a figure needs one panel or more")
    rows = [problems[first : first + columns] for first in range(0, len(problems), columns)]
    widths = [[problem.grid.width for problem in row] for row in rows]
    heights = [max(problem.grid.height for problem in row) for row in rows]
    # Inches a metre, so that the widest row fills the figure.
    scale = min((width - _GAP * (len(row) + 1)) / sum(row) for row in widths)
    height = sum(heights) * scale + _HEADER * len(rows) + _FOOTER
    figure = Figure(figsize=(width, height), dpi=DPI, facecolor="white")
    axes, bottom = [], height
    for row, row_height in zip(rows, heights, strict=True):
        bottom -= row_height * scale + _HEADER
        left = _GAP
        for problem in row:
            size = problem.grid.width * scale, problem.grid.height * scale
            box = (left / width, bottom / height, size[0] / width, size[1] / height)
            axes.append(figure.add_axes(box))
            left += size[0] + _GAP
    _draw_scale_bar(axes[(len(rows) - 1) * columns], scale)
    return figure, axes


def draw_scene(
    axes: Axes, problem: Problem, title: str, detail: str = "", *, heat: Region | None = None
) -> None:
    """Draw the map of a problem with start and goal, under a title.

    Args:
        axes: A panel.
        problem: The problem.
        title: The first line above the map.
        detail: The second line.
        heat: Its probabilities are drawn on the floor; None for a bare map.
    """
    view = make_view(problem.grid, [problem.start[:2], problem.goal[:2]])
    inches = axes.get_position().width * _figure(axes).get_size_inches()[0]
    draw_map(axes, view, problem.robot.radius, heat, pixels=int(2 * DPI * inches))
    low, high = view.world_bounds()
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), xticks=[], yticks=[])
    axes.spines[:].set_visible(False)
    axes.set_autoscale_on(False)
    draw_ends(axes, problem)
    _write_above(axes, 20, title, size=12, weight="bold", color=style.INK)
    _write_above(axes, 5, detail, size=10, color=style.MUTED)


def _write_above(axes: Axes, points: float, text: str, **looks: Any) -> None:
    axes.annotate(
        text,
        (0.0, 1.0),
        (0, points),
        xycoords="axes fraction",
        textcoords="offset points",
        va="bottom",
        **looks,
    )


def draw_plan(axes: Axes, result: PlanResult) -> None:
    """Draw what a plan found, with the vertices of the tree."""
    draw_result(axes, result)
    if result.tree is not None:
        axes.plot(
            *result.tree.vertices[:, :2].T,
            ls="none",
            marker=".",
            ms=_VERTEX,
            mew=0.0,
            color=style.VERTEX,
            zorder=3.5,
        )


def draw_mask(axes: Axes, problem: Problem, region: Region) -> None:
    """Darken what lies outside of a region."""
    x, y, yaw = problem.grid.origin
    shade = np.zeros((*region.mask.shape, 4))
    shade[~region.mask] = to_rgba(style.OBSTACLE, _MASK_OPACITY)
    extent = (0.0, problem.grid.width, 0.0, problem.grid.height)
    image = axes.imshow(shade, origin="lower", extent=extent, interpolation="nearest", zorder=1.5)
    image.set_transform(Affine2D().rotate(yaw).translate(x, y) + axes.transData)


def draw_anchors(axes: Axes, region: Region) -> None:
    """Mark the anchors that are selected."""
    chosen = region.anchors[region.selected]
    axes.plot(*chosen.T, ls="none", marker="s", ms=2.6, color=style.REGION, zorder=3)


def draw_headings(axes: Axes, region: Region) -> None:
    """Draw where a car's samples come from: ellipses along the headings, with their direction.

    Args:
        axes: A panel.
        region: A region with headings.
    """
    sampling = region.sampling()
    if sampling is None or sampling.headings is None:
        return
    centres = sampling.anchors
    if sampling.offsets is not None:
        centres = centres + sampling.offsets
    length = np.full(len(centres), 2.0 * sampling.half_width)
    ellipses = EllipseCollection(
        length,
        ELLIPSE_ASPECT * length,
        np.degrees(sampling.headings),
        units="xy",
        offsets=centres,
        offset_transform=axes.transData,
        facecolors=to_rgba(style.REGION, 0.10),
        edgecolors=to_rgba(style.REGION, 0.35),
        linewidths=0.6,
        zorder=2,
    )
    axes.add_collection(ellipses)
    towards = np.column_stack((np.cos(sampling.headings), np.sin(sampling.headings)))
    tips = centres + _TICK * sampling.half_width * towards
    strokes = list(np.stack((centres, tips), axis=1))
    axes.add_collection(LineCollection(strokes, colors=style.REGION, linewidths=1.0, zorder=3))
    axes.plot(*centres.T, ls="none", marker="o", ms=2.2, color=style.REGION, zorder=3)


def draw_colour_bar(axes: Axes) -> None:
    """Draw the scale of the probabilities below a panel."""
    box, figure = axes.get_position(), _figure(axes)
    height = figure.get_size_inches()[1]
    place = (box.x0 + 0.6 * box.width, box.y0 - 0.18 / height, 0.35 * box.width, 0.11 / height)
    fill_colour_bar(figure.add_axes(place), 9.0)


def _figure(axes: Axes) -> Figure:
    figure = axes.get_figure(root=True)
    assert figure is not None
    return figure


def _draw_scale_bar(axes: Axes, scale: float) -> None:
    """Draw a bar of a round number of metres below a panel, with `scale` inches a metre."""
    box, figure = axes.get_position(), _figure(axes)
    width, height = figure.get_size_inches()
    length = nice_length(1.5 / scale)
    place = (box.x0, box.y0 - 0.12 / height, length * scale / width, 1e-6)
    bar = figure.add_axes(place, frameon=False)
    bar.set(xlim=(0.0, 1.0), ylim=(0.0, 1.0), xticks=[], yticks=[])
    bar.plot([0.0, 1.0], [0.0, 0.0], color=style.INK, lw=1.6, marker="|", ms=6, clip_on=False)
    bar.annotate(
        f"{length:g} m",
        (1.0, 0.0),
        (6, 0),
        textcoords="offset points",
        va="center",
        color=style.INK,
    )
