"""Colours of the pictures: warm floor, cool walls, so that heat, path and markers stand out."""

from __future__ import annotations

import functools

import numpy as np
from matplotlib import colormaps
from matplotlib.colors import Colormap, ListedColormap
from numpy.typing import NDArray

FLOOR = "#fbf8f1"
MARGIN = "#efeae0"
UNKNOWN = "#bdc1c5"
OBSTACLE = "#2b3441"

INK = "#20262e"
MUTED = "#6b7480"
ALARM = "#c22f3d"

PATH = "#1257d6"
HALO = "#ffffff"
TREE = "#3f6b8f"
VERTEX = "#d17a00"
REGION = "#a3357a"
START = "#00a67d"
GOAL = "#d81e4a"

_LIGHTEST, _DARKEST = 0.95, 0.42
"""Part of the colour map in use: lighter is lost on the floor, darker looks like a wall."""
_OPACITY = 0.88
_FULL_FROM = 0.55
"""Probability from which the heat is as opaque as it gets."""


@functools.cache
def heat_colours() -> Colormap:
    """Perceptually uniform from yellow to purple (plasma), transparent where low."""
    values = np.linspace(0.0, 1.0, 256)
    colours = colormaps["plasma"](_LIGHTEST + (_DARKEST - _LIGHTEST) * values)
    ramp = np.clip(values / _FULL_FROM, 0.0, 1.0)
    colours[:, 3] = _OPACITY * ramp * ramp * (3.0 - 2.0 * ramp)
    return ListedColormap(colours, name="planformer_heat")


def rgb(colour: str) -> NDArray[np.float32]:
    """(3,) float32 in [0, 1] of a colour like "#fbf8f1"."""
    return np.array([int(colour[i : i + 2], 16) / 255.0 for i in (1, 3, 5)], np.float32)
