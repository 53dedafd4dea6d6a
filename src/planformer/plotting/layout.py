"""Where things are on a picture; all sizes in inches."""

from __future__ import annotations

from dataclasses import dataclass

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from planformer.plotting.save import encoded
from planformer.plotting.view import View

DPI = 160
_SHOWN_DPI = 72
"""Pixels an inch in a notebook: smaller than in a file, and sharp on any screen."""
_AREA = 56.0
_MIN_SIDE, _MAX_SIDE = 2.0, 12.0
_MIN_WIDTH = 7.0
_LEFT, _RIGHT, _TOP, _BOTTOM = 0.55, 0.25, 0.82, 0.88


class Picture(Figure):
    """A figure that notebooks show by itself, without pyplot and its global state."""

    def _repr_png_(self) -> tuple[bytes, dict[str, int]]:
        width, height = (round(side * _SHOWN_DPI) for side in self.get_size_inches().tolist())
        return encoded(self, "png"), {"width": width, "height": height}


@dataclass(frozen=True)
class Layout:
    """A figure with axes for the map, in world metres, and room for text above and below.

    Attributes:
        figure: The figure.
        axes: The map's axes.
    """

    figure: Figure
    axes: Axes

    def at(self, x: float, y: float) -> tuple[float, float]:
        """Figure coordinates of a point, from the left edge and from the top, in inches.

        Negative values count from the right edge and from the bottom.
        """
        width, height = self.figure.get_size_inches()
        return (x % width) / width, ((-y) % height) / height

    def inches_per_metre(self) -> float:
        """The map's scale on paper."""
        box = self.axes.get_position(original=True)
        figure_width, figure_height = self.figure.get_size_inches()
        (left, right), (low, high) = self.axes.get_xlim(), self.axes.get_ylim()
        across = box.width * figure_width / (right - left)
        return float(min(across, box.height * figure_height / (high - low)))


def make_layout(view: View) -> Layout:
    """Lay out a picture: wide, tall and turned maps alike fill it."""
    low, high = view.world_bounds()
    width, height = _map_size(*(high - low))
    figure = Picture(
        figsize=(max(width, _MIN_WIDTH) + _LEFT + _RIGHT, height + _TOP + _BOTTOM),
        dpi=DPI,
        facecolor="white",
    )
    total_width, total_height = figure.get_size_inches()
    axes = figure.add_axes(
        (
            _LEFT / total_width,
            _BOTTOM / total_height,
            1.0 - (_LEFT + _RIGHT) / total_width,
            1.0 - (_TOP + _BOTTOM) / total_height,
        )
    )
    axes.set_aspect("equal", adjustable="box", anchor="C")
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(low[1], high[1])
    axes.set_autoscale_on(False)
    return Layout(figure, axes)


def _map_size(width: float, height: float) -> tuple[float, float]:
    """Inches for a map of the given extent: about the same area whatever its shape."""
    aspect = width / height
    across, up = (_AREA * aspect) ** 0.5, (_AREA / aspect) ** 0.5
    across, up = (min(max(side, _MIN_SIDE), _MAX_SIDE) for side in (across, up))
    # No empty space along the side that a bound has lengthened.
    return min(across, _MAX_SIDE, max(up * aspect, _MIN_SIDE)), min(up, max(across / aspect, 1.0))
