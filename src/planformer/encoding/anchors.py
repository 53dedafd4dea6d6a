"""Anchor points: where the tokens of a network are, their labels and the region they span."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from planformer.encoding.scale import NetworkScale
from planformer.errors import InvalidParameter
from planformer.geometry import distance_to_polyline, offset_to_polyline

LABEL_DISTANCE = 0.7
"""Anchors no farther than this from the path, in metres, are positive (as in the paper's code)."""

_SPACING = 0.1
"""Metres between the points of a path whose headings are averaged."""


def anchor_points(height: int, width: int, scale: NetworkScale) -> NDArray[np.float64]:
    """Centres of the tokens' patches.

    Args:
        height: Rows of the network map in pixels, a multiple of the stride.
        width: Columns of the network map in pixels, a multiple of the stride.
        scale: The network's scale.

    Returns:
        (h, w, 2) points (x, y) in metres in the map's local frame, h = height / stride.

    Raises:
        InvalidParameter: A size is no positive multiple of the stride.
    """
    y, x = (_anchor_pixels(size, scale) * scale.resolution for size in (height, width))
    return np.stack(np.broadcast_arrays(x[None, :], y[:, None]), axis=-1)


def _anchor_pixels(size: int, scale: NetworkScale) -> NDArray[np.int_]:
    if size < 1 or size % scale.stride:
        raise InvalidParameter(
            f"a network map's sides must be multiples of {scale.stride} px; got {size}"
        )
    return np.arange(size // scale.stride) * scale.stride + scale.anchor_offset


def anchor_labels(anchors: NDArray[np.float64], path: ArrayLike) -> NDArray[np.bool_]:
    """Mark the anchors near a path.

    Args:
        anchors: (h, w, 2) points in metres.
        path: (N, 2) or (N, 3) path in metres; yaw does not count.

    Returns:
        (h, w) bool, True within 0.7 m of the path.
    """
    vertices = np.asarray(path, dtype=np.float64)[:, :2]
    positive: NDArray[np.bool_] = distance_to_polyline(anchors, vertices) <= LABEL_DISTANCE
    return positive.reshape(anchors.shape[:2])


def anchor_headings(anchors: NDArray[np.float64], path: ArrayLike) -> NDArray[np.float32]:
    """Average direction of a path near each anchor.

    Args:
        anchors: (h, w, 2) points in metres.
        path: (N, 2) or (N, 3) path in metres, driven from its first point to its last.

    Returns:
        (2, h, w) float32 mean of the unit vectors (cos, sin) along the path within 0.7 m; the more
        the path turns there, the shorter. Zero where there is no path.
    """
    points, directions = _densified(np.asarray(path, dtype=np.float64)[:, :2])
    offsets = anchors.reshape(-1, 1, 2) - points
    near = np.hypot(offsets[..., 0], offsets[..., 1]) <= LABEL_DISTANCE
    mean = near @ directions / np.maximum(near.sum(axis=1, keepdims=True), 1)
    headings: NDArray[np.float32] = mean.T.reshape(2, *anchors.shape[:2]).astype(np.float32)
    return headings


def anchor_offsets(anchors: NDArray[np.float64], path: ArrayLike) -> NDArray[np.float32]:
    """Way from each anchor to the path.

    Args:
        anchors: (h, w, 2) points in metres.
        path: (N, 2) or (N, 3) path in metres; yaw does not count.

    Returns:
        (2, h, w) float32 vectors (x, y) in metres to the nearest point of a path within 0.7 m; zero
        where there is no path.
    """
    vertices = np.asarray(path, dtype=np.float64)[:, :2]
    offsets = offset_to_polyline(anchors, vertices)
    offsets[np.hypot(*offsets.T) > LABEL_DISTANCE] = 0.0
    vectors: NDArray[np.float32] = offsets.T.reshape(2, *anchors.shape[:2]).astype(np.float32)
    return vectors


def _densified(
    path: NDArray[np.float64],
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Evenly spaced points of a path and the unit direction of travel at each."""
    points, directions = [np.empty((0, 2))], [np.empty((0, 2))]
    for a, b in pairwise(path):
        length = math.hypot(*(b - a))
        if length > 0:
            count = math.ceil(length / _SPACING)
            along = (np.arange(count) + 0.5) / count
            points.append(a + along[:, None] * (b - a))
            directions.append(np.tile((b - a) / length, (count, 1)))
    return np.concatenate(points), np.concatenate(directions)


def region_mask(selected: NDArray[np.bool_], scale: NetworkScale) -> NDArray[np.bool_]:
    """Union of the patches of the selected tokens.

    Args:
        selected: (h, w) bool.
        scale: The network's scale.

    Returns:
        (h * stride, w * stride) bool, True inside a selected token's patch.
    """
    mask = _dilated(np.asarray(selected, dtype=bool), scale)
    return np.ascontiguousarray(_dilated(mask.T, scale).T)


def _dilated(selected: NDArray[np.bool_], scale: NetworkScale) -> NDArray[np.bool_]:
    """Along axis 0: spread every token over the pixels of its patch."""
    size = selected.shape[0] * scale.stride
    first = _anchor_pixels(size, scale) - scale.patch // 2
    steps = np.zeros((size + 1, selected.shape[1]), np.int32)
    np.add.at(steps, np.clip(first, 0, size), selected)
    np.subtract.at(steps, np.clip(first + scale.patch, 0, size), selected)
    covered: NDArray[np.bool_] = steps.cumsum(axis=0)[:size] > 0
    return covered
