"""Bring a robot's configuration-space map to the scale of a network."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from planformer.encoding.scale import NetworkScale, QueryKind
from planformer.errors import InvalidMap, InvalidParameter
from planformer.maps.resample import any_overlapped, resampled_size

_SAME_RATIO = 1e-6
"""Cells that are a pixel but for this are not resampled."""

_MOST_PIXELS, _MOST_PIXELS_AT_ONCE = 2**26, 2**22
"""Networks that are shown waves see windows of the map, others all of it at once, and attention
takes memory with the square of its pixels. Both limits stand for about a gigabyte."""


def network_map(blocked: ArrayLike, resolution: float, scale: NetworkScale) -> NDArray[np.uint8]:
    """Rasterise blocked cells for a network.

    A network pixel is blocked when any cell that it overlaps is, so no wall is lost. The map is
    padded with blocked pixels at the top and right to a multiple of the stride. The networks see
    the map inflated by the robot, where the paper gives them the bare obstacles: one network
    then serves every robot radius.

    Args:
        blocked: (H, W) bool, row 0 = lowest y; True where the robot's centre must not be.
        resolution: Side of a cell in metres.
        scale: The network's scale.

    Returns:
        (H', W') uint8, 1 = blocked; both sizes are multiples of `scale.stride`.

    Raises:
        InvalidMap: The map is not two-dimensional or empty, or too large for the network.
        InvalidParameter: The resolution is not finite and positive.
    """
    cells = np.asarray(blocked, dtype=bool)
    if cells.ndim != 2 or cells.size == 0:
        raise InvalidMap(f"a map must have shape (H, W) with H, W >= 1; got {cells.shape}")
    if not (math.isfinite(resolution) and resolution > 0):
        raise InvalidParameter(f"resolution must be finite and > 0 m; got {resolution}")
    ratio = scale.resolution / resolution
    _check_size(cells.shape, ratio, scale)
    if abs(ratio - 1.0) > _SAME_RATIO:
        cells = any_overlapped(cells, ratio, outside=False)
    return _pad(cells, scale)


def network_shape(shape: tuple[int, ...], resolution: float, scale: NetworkScale) -> list[int]:
    """Rows and columns of `network_map` of a map of (H, W) cells."""
    ratio = scale.resolution / resolution
    same = abs(ratio - 1.0) <= _SAME_RATIO
    return [scale.padded(size if same else resampled_size(size, ratio)) for size in shape]


def _check_size(shape: tuple[int, ...], ratio: float, scale: NetworkScale) -> None:
    """Few cells of a great size are many pixels."""
    height, width = (size / ratio for size in shape)
    most = _MOST_PIXELS if scale.query is QueryKind.WAVEFRONT else _MOST_PIXELS_AT_ONCE
    if height * width > most:
        raise InvalidMap(
            f"a map of {height:.0f} x {width:.0f} pixels of {scale.resolution:g} m is too large "
            f"for this network, which takes {most:,}; plan without a guide, or in a part of the map"
        )


def _pad(cells: NDArray[np.bool_], scale: NetworkScale) -> NDArray[np.uint8]:
    height, width = cells.shape
    pixels = np.ones((scale.padded(height), scale.padded(width)), np.uint8)
    pixels[:height, :width] = cells
    return pixels
