"""Anchor points: where the tokens of a network are, their labels and the region they span."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from planformer.encoding.scale import NetworkScale
from planformer.errors import InvalidParameter
from planformer.geometry import distance_to_polyline, offset_to_polyline

LABEL_DISTANCE = 0.7
"""Anchors no farther than this from the path, in metres, are positive (as in the paper's code)."""

_PIECE = 2.0
"""Metres of a path that are compared with the anchors at once."""

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
        anchors: (h, w, 2) points in metres, a lattice as that of `anchor_points`.
        path: (N, 2) or (N, 3) path in metres; yaw does not count.

    Returns:
        (h, w) bool, True within 0.7 m of the path.
    """
    x, y = anchors[0, :, 0], anchors[:, 0, 1]
    labels = np.zeros(anchors.shape[:2], bool)
    for piece in _short_pieces(np.asarray(path, dtype=np.float64)[:, :2]):
        # A U-Net has an anchor in each pixel: only those round the piece are looked at.
        near = np.s_[_within(y, piece[:, 1]), _within(x, piece[:, 0])]
        distance = distance_to_polyline(anchors[near], piece)
        labels[near] |= distance.reshape(labels[near].shape) <= LABEL_DISTANCE
    return labels


def _short_pieces(path: NDArray[np.float64]) -> list[NDArray[np.float64]]:
    """A path cut at some of its vertices, into pieces of two metres or of one segment."""
    along = np.hypot(*np.diff(path, axis=0).T).cumsum()
    cuts = np.flatnonzero(np.diff(along // _PIECE)) + 1
    ends = [0, *cuts.tolist(), max(len(path) - 1, 0)]
    return [path[first : last + 1] for first, last in pairwise(ends)]


def _within(axis: NDArray[np.float64], values: NDArray[np.float64]) -> slice:
    """Where an ascending axis is within the label distance of some values."""
    first = np.searchsorted(axis, values.min() - LABEL_DISTANCE, side="left")
    last = np.searchsorted(axis, values.max() + LABEL_DISTANCE, side="right")
    return slice(int(first), int(last))


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
    dx, dy = (anchors[..., axis].reshape(-1, 1) - points[:, axis] for axis in (0, 1))
    near = (dx * dx + dy * dy <= LABEL_DISTANCE**2).astype(np.float64)
    mean = near @ directions / np.maximum(near.sum(axis=1, keepdims=True), 1.0)
    headings: NDArray[np.float32] = mean.T.reshape(2, *anchors.shape[:2]).astype(np.float32)
    return headings


def anchor_offsets(anchors: NDArray[np.float64], path: ArrayLike) -> NDArray[np.float64]:
    """Way from each anchor to the path.

    Args:
        anchors: (h, w, 2) points in metres.
        path: (N, 2) or (N, 3) path in metres; yaw does not count.

    Returns:
        (h, w, 2) float64 vectors in metres to the nearest point of the path.
    """
    vertices = np.asarray(path, dtype=np.float64)[:, :2]
    return offset_to_polyline(anchors, vertices).reshape(anchors.shape)


def _densified(
    path: NDArray[np.float64],
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Evenly spaced points of a path and the unit direction of travel at each."""
    steps = np.diff(path, axis=0)
    lengths = np.hypot(steps[:, 0], steps[:, 1])
    counts = np.ceil(lengths / _SPACING).astype(np.intp)
    segment = np.repeat(np.arange(len(steps)), counts)
    number = np.arange(len(segment)) - np.repeat(np.cumsum(counts) - counts, counts)
    along = (number + 0.5) / counts[segment]
    points = path[segment] + along[:, None] * steps[segment]
    return points, steps[segment] / lengths[segment][:, None]


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
