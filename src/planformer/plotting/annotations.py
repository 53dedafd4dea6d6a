"""What explains a picture: title, caption, legend, colour bar, scale bar, axes."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator

from planformer.planning import PlanResult
from planformer.plotting import style
from planformer.plotting.layout import Layout
from planformer.plotting.words import caption

_SCALE_BAR = 1.5
"""Greatest length of the scale bar in inches."""


def draw_annotations(layout: Layout, result: PlanResult, title: str | None) -> None:
    """Draw everything that stands beside the map."""
    _draw_axes(layout)
    _draw_texts(layout, result, title)
    _draw_legend(layout, result)
    _draw_scale_bar(layout)
    if result.region is not None:
        _draw_colour_bar(layout)


def nice_length(extent: float) -> float:
    """The largest of 1, 2, 5, 10, ... (and 0.5, 0.2, ...) that is at most `extent`."""
    # 0.5 is there for an extent just below a power of ten that log10 rounds up.
    power = 10.0 ** math.floor(math.log10(extent))
    return max(step * power for step in (0.5, 1.0, 2.0, 5.0) if step * power <= extent)


def _draw_axes(layout: Layout) -> None:
    axes = layout.axes
    axes.tick_params(length=2.5, color=style.MUTED, labelcolor=style.MUTED, labelsize=7.5)
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(MaxNLocator(nbins=8, steps=[1, 2, 5, 10]))
    for spine in axes.spines.values():
        spine.set_visible(False)


def _draw_texts(layout: Layout, result: PlanResult, title: str | None) -> None:
    figure = layout.figure
    left = 0.55
    if title:
        figure.text(*layout.at(left, 0.36), title, size=14, weight="bold", color=style.INK)
    figure.text(
        *layout.at(left, 0.62),
        caption(result),
        size=8.5,
        color=style.MUTED if result.solved else style.ALARM,
    )


def _draw_legend(layout: Layout, result: PlanResult) -> None:
    legend = layout.figure.legend(
        handles=_handles(result),
        loc="center left",
        bbox_to_anchor=layout.at(0.5, -0.29),
        ncols=5,
        frameon=False,
        fontsize=8.5,
        labelcolor=style.INK,
        borderpad=0.0,
        handletextpad=0.55,
        columnspacing=1.5,
    )
    legend.set_zorder(1)


def _handles(result: PlanResult) -> list[Artist]:
    symbols = (">", ">") if result.problem.robot.state_dimension == 3 else ("o", "*")
    handles: list[Artist] = [
        Line2D(
            [],
            [],
            linestyle="none",
            marker=symbol,
            markersize=size,
            label=label,
            markerfacecolor=colour,
            markeredgecolor=style.HALO,
        )
        for label, colour, symbol, size in (
            ("start", style.START, symbols[0], 9.0),
            ("goal", style.GOAL, symbols[1], 9.0 if symbols[1] == ">" else 13.0),
        )
    ]
    if result.solved:
        handles.append(Line2D([], [], color=style.PATH, linewidth=2.5, label="path"))
    if result.tree is not None:
        handles.append(Line2D([], [], color=style.TREE, linewidth=0.8, label="search tree"))
    if result.region is not None:
        handles.append(Line2D([], [], color=style.REGION, linewidth=1.0, label="region"))
    return handles


def _draw_colour_bar(layout: Layout) -> None:
    width, height = layout.figure.get_size_inches()
    left, bottom = layout.at(-1.45, 0.35)
    fill_colour_bar(layout.figure.add_axes((left, bottom, 1.05 / width, 0.11 / height)), 7.5)


def fill_colour_bar(axes: Axes, text_size: float) -> None:
    """Make axes a bar of the colours of probabilities, with text of some points beside it."""
    axes.imshow(
        np.linspace(0.0, 1.0, 256)[None],
        cmap=style.heat_colours(),
        aspect="auto",
        extent=(0.0, 1.0, 0.0, 1.0),
    )
    axes.set_facecolor(style.FLOOR)
    axes.set_axis_off()
    for x, text, side in ((-0.06, "probability  0", "right"), (1.06, "1", "left")):
        axes.text(x, 0.42, text, size=text_size, color=style.MUTED, ha=side, va="center")


def _draw_scale_bar(layout: Layout) -> None:
    """Draw a bar of a round number of metres in the lower right corner."""
    figure, scale = layout.figure, layout.inches_per_metre()
    length = nice_length(_SCALE_BAR / scale)
    ends = [layout.at(-0.25 - length * scale, -0.26), layout.at(-0.25, -0.26)]
    x, y = zip(*ends, strict=True)
    figure.add_artist(Line2D(x, y, color=style.INK, linewidth=1.6, solid_capstyle="butt"))
    figure.add_artist(Line2D(x, y, color=style.INK, linestyle="none", marker="|", markersize=6))
    middle = layout.at(-0.25 - 0.5 * length * scale, -0.32)
    figure.text(*middle, f"{length:g} m", size=8.5, color=style.INK, ha="center", va="bottom")
