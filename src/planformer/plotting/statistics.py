"""How systems compare over many problems: letter values, and shares solved by a deadline."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, PercentFormatter
from numpy.typing import NDArray

from planformer.plotting.outcomes import Outcomes, require_outcomes
from planformer.plotting.style import ALARM, INK, MARGIN, MUTED

_DPI = 160
_WIDTH = 10.0
_SYSTEM_HEIGHT = 0.3
"""Inches of a system's line in a plot of letter values."""
_ROOM = 1.4
"""Factor from the outmost values to the ends of their axis."""
_TIMES = 500
"""Points of a curve, so that its file does not grow with the number of problems."""


def plot_letter_values(systems: Sequence[Outcomes], limit: float, title: str) -> Figure:
    """Draw how time and vertices are distributed, as letter values on log scales.

    Hofmann, Wickham and Kafadar, Letter-Value Plots: Boxplots for Large Data, Journal of
    Computational and Graphical Statistics 26, 2017. Failures are drawn with the time and the
    vertices that count for them, and their number is written beside the system's time.

    Args:
        systems: The systems, from top to bottom.
        limit: Limit of a search in seconds, drawn as a line.
        title: Line above the plot.

    Returns:
        A Matplotlib figure with axes of time and of vertices; see `save_picture`.

    Raises:
        InvalidResults: There is nothing to draw.
    """
    require_outcomes(systems)
    figure = _figure(_SYSTEM_HEIGHT * len(systems) + 1.0, title)
    time, vertices = figure.subplots(1, 2, sharey=True)
    _draw_times(time, systems, limit)
    _draw_vertices(vertices, systems)
    # After the drawing, as seaborn sets up the scales anew.
    _decorate(time, "time, proposal included [s]")
    _decorate(vertices, "vertices of the search tree")
    time.set_yticks(range(len(systems)), [system.name for system in systems], color=INK)
    time.set_ylim(len(systems) - 0.4, -0.6)
    return figure


def plot_solved(systems: Sequence[Outcomes], limit: float, title: str) -> Figure:
    """Draw the share of the problems that each system has solved by a deadline.

    Args:
        systems: The systems, in the order of the legend.
        limit: Limit of a search in seconds. The curves end there, or at the last problem that is
            solved: a proposal takes time beside the search.
        title: Line above the plot.

    Returns:
        A Matplotlib figure; the legend tells the shares at the end. See `save_picture`.

    Raises:
        InvalidResults: There is nothing to draw.
    """
    require_outcomes(systems)
    figure = _figure(5.2, title)
    axes = figure.subplots()
    _decorate(axes, "deadline, proposal included [s]")
    times = np.concatenate([system.seconds[system.solved] for system in systems] + [[limit]])
    deadlines = np.geomspace(min(0.8 * times.min(), 0.1 * limit), times.max(), _TIMES)
    for system in systems:
        shares = shares_solved(system, deadlines)
        label = f"{system.name}  {shares[-1]:.1%}"
        axes.plot(deadlines, shares, color=system.colour, ls=system.dashes, lw=1.6, label=label)
    axes.set_xlim(deadlines[0], deadlines[-1])
    axes.set_ylim(0.0, 1.01)
    axes.set_ylabel("problems solved", color=INK)
    axes.yaxis.set_major_formatter(PercentFormatter(1.0))
    figure.legend(
        title="solved",
        loc="outside right center",
        frameon=False,
        fontsize=8.5,
        title_fontsize=8.5,
        labelcolor=INK,
        handlelength=3.6,
    )
    return figure


def shares_solved(system: Outcomes, deadlines: NDArray[np.float64]) -> NDArray[np.float64]:
    """Share of the problems that are solved within each deadline in seconds, 0 to 1."""
    times = np.sort(system.seconds[system.solved])
    return np.searchsorted(times, deadlines, side="right") / len(system.solved)


def _figure(height: float, title: str) -> Figure:
    figure = Figure(figsize=(_WIDTH, height), dpi=_DPI, facecolor="white", layout="constrained")
    figure.suptitle(title, x=0.01, ha="left", fontsize=11, weight="bold", color=INK)
    return figure


def _draw_times(axes: Axes, systems: Sequence[Outcomes], limit: float) -> None:
    _set_range(axes, [*(system.seconds for system in systems), np.array([limit])])
    for y, system in enumerate(systems):
        _draw_letter_values(axes, y, system.seconds, system.colour)
        if system.failures:
            _note(axes, y, f"{system.failures:,} failed", ALARM)
    _draw_limit(axes, limit)


def _draw_vertices(axes: Axes, systems: Sequence[Outcomes]) -> None:
    # A run that ended before its search counts with the one vertex of the start.
    sizes = [np.maximum(system.vertices, 1.0) for system in systems]
    _set_range(axes, [values for values in sizes if values.max() > 1.0] or sizes)
    for y, (system, values) in enumerate(zip(systems, sizes, strict=True)):
        if system.vertices.any():
            _draw_letter_values(axes, y, values, system.colour)
        else:
            _note(axes, y, "no tree", MUTED)


def _set_range(axes: Axes, values: Sequence[NDArray[np.float64]]) -> None:
    """Make the x axis logarithmic, with room round all values."""
    every = np.concatenate(values)
    axes.set_xscale("log")
    axes.set_xlim(every.min() / _ROOM, every.max() * _ROOM)


def _draw_letter_values(axes: Axes, y: int, values: NDArray[np.float64], colour: str) -> None:
    """Draw the values of one system at its height."""
    import seaborn  # loads pandas, which takes as long as the rest of the package

    seaborn.boxenplot(
        x=values,
        y=np.full(len(values), y),
        orient="h",
        native_scale=True,
        log_scale=(True, False),
        color=colour,
        saturation=1.0,
        width=0.8,
        linewidth=0.5,
        linecolor=INK,
        line_kws={"linewidth": 1.6, "color": INK},
        flier_kws={"s": 9, "facecolor": colour, "edgecolor": "none"},
        ax=axes,
    )


def _draw_limit(axes: Axes, limit: float) -> None:
    axes.axvline(limit, color=ALARM, lw=1.0, ls="--", zorder=0.9)
    axes.text(
        limit,
        1.0,
        f"limit {limit:g} s",
        transform=axes.get_xaxis_transform(),
        ha="center",
        va="bottom",
        fontsize=7.5,
        color=ALARM,
    )


def _note(axes: Axes, y: int, text: str, colour: str) -> None:
    """Write something at the right edge, at the height of a system."""
    axes.annotate(
        text,
        (1.0, y),
        xycoords=axes.get_yaxis_transform(),
        xytext=(4, 0),
        textcoords="offset points",
        va="center",
        fontsize=7.5,
        color=colour,
        annotation_clip=False,
    )


def _decorate(axes: Axes, label: str) -> None:
    axes.set_xscale("log")
    axes.set_xlabel(label, color=INK)
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:,g}"))
    axes.grid(color=MARGIN, which="both", axis="x", lw=0.5)
    axes.grid(color=MARGIN, which="major", lw=1.0)
    axes.set_axisbelow(True)
    axes.tick_params(which="both", colors=MUTED, labelsize=8.5)
    axes.spines[["top", "right"]].set_visible(False)
