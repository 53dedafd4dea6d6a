"""The picture of a training: how loss, accuracy and regions went."""

from __future__ import annotations

import csv
import os
from collections.abc import Iterator
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from planformer.errors import InvalidParameter
from planformer.plotting.style import GOAL, INK, MARGIN, MUTED, PATH, REGION, START, TREE

_ALL = "all"
_COLOURS = (PATH, REGION, START, GOAL, TREE)
_DPI = 130
_Series = dict[str, tuple[list[float], list[float]]]

_PANELS = (
    ("loss", "loss", 1.0),
    ("connected", "start and goal connected [%]", 100.0),
    ("recall", "recall of anchors [%]", 100.0),
    ("precision", "precision of anchors [%]", 100.0),
    ("region", "region's share of the map [%]", 100.0),
)


def plot_training(log: str | os.PathLike[str]) -> Figure:
    """Draw the validations of a training over its steps, a line for each kind of map.

    Args:
        log: The ``log.csv`` that a training writes.

    Returns:
        A Matplotlib figure; see `save_picture`.

    Raises:
        InvalidParameter: The file is missing or no such log.
    """
    rows = _read(Path(log))
    kinds = sorted({row["kind"] for row in rows} - {_ALL})
    colours = {_ALL: INK, **{kind: _COLOURS[i % len(_COLOURS)] for i, kind in enumerate(kinds)}}
    figure = Figure(figsize=(7.5, 9.5), dpi=_DPI, facecolor="white", layout="constrained")
    panels = figure.subplots(len(_PANELS), 1, sharex=True)
    for axes, (column, label, factor) in zip(panels, _PANELS, strict=True):
        for kind, (steps, values) in _series(rows, column, factor).items():
            _draw(axes, steps, values, label=kind, colour=colours[kind], emphasised=kind == _ALL)
        _decorate(axes, label)
    steps, losses = _series(rows, "train_loss")[_ALL]
    panels[0].plot(steps, losses, color=MUTED, ls=":", lw=1.0, label="training")
    if panels[0].dataLim.ymin > 0:  # the likelihood of headings can be negative
        panels[0].set_yscale("log")
        panels[0].yaxis.set_major_formatter("{x:g}")
        panels[0].yaxis.set_minor_formatter("{x:g}")
    lines = panels[0].get_legend_handles_labels()
    figure.legend(*lines, loc="outside upper center", ncols=5, frameon=False, fontsize=9)
    panels[-1].set_xlabel("step", color=INK)
    panels[-1].xaxis.set_major_locator(MaxNLocator(integer=True, steps=[1, 2, 5, 10]))
    return figure


def _read(log: Path) -> list[dict[str, str]]:
    """The rows of a log, at least one of each validation."""
    needed = {"step", "kind", "train_loss", *(column for column, _, _ in _PANELS)}
    try:
        with log.open(newline="", encoding="utf-8") as file:
            reader = csv.DictReader(file)
            missing = needed - set(reader.fieldnames or ())
            rows = list(reader)
    except (OSError, UnicodeDecodeError) as error:
        raise InvalidParameter(f"{log}: cannot be read: {error}") from error
    if missing or not any(row["kind"] == _ALL for row in rows):
        raise InvalidParameter(f"{log} is no log of a training: it needs {sorted(needed)}")
    return rows


def _series(rows: list[dict[str, str]], column: str, factor: float = 1.0) -> _Series:
    """Steps and values of a column by kind of map, "all" last so that it lies on top."""
    series: _Series = {}
    for kind, step, value in _values(rows, column):
        steps, values = series.setdefault(kind, ([], []))
        steps.append(step)
        values.append(factor * value)
    series[_ALL] = series.pop(_ALL)
    return series


def _values(rows: list[dict[str, str]], column: str) -> Iterator[tuple[str, float, float]]:
    try:
        for row in rows:
            yield row["kind"], float(row["step"]), float(row[column])
    except (TypeError, ValueError) as error:
        raise InvalidParameter(f"{column} must be a number in every row: {error}") from error


def _draw(
    axes: Axes,
    steps: list[float],
    values: list[float],
    *,
    label: str,
    colour: str,
    emphasised: bool,
) -> None:
    width, size = (2.0, 4.0) if emphasised else (1.2, 2.5)
    axes.plot(steps, values, color=colour, lw=width, marker="o", ms=size, label=label)


def _decorate(axes: Axes, label: str) -> None:
    axes.set_title(label, loc="left", fontsize=9, color=INK)
    axes.grid(color=MARGIN)
    axes.tick_params(which="both", colors=MUTED, labelsize=8)
    axes.spines[["top", "right"]].set_visible(False)
