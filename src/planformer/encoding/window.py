"""The part of a map that matters to a query."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from planformer.encoding.scale import NetworkScale

TILE = 40
"""Tokens along the side of a tile. What matters on a large map is no rectangle: most tiles of the
one round it can be left out."""

MARGIN = 2
"""Tokens round those that matter. With two, these tokens' probabilities change by 0.02 (median of
the largest change on a map), with none by 0.1; the region has the same size either way."""

_KEPT = 1
"""Tokens of the margin whose prediction counts where no window is about them, for a path may pass
there as well."""


@dataclass(frozen=True)
class Window:
    """A rectangle of the tokens of a map.

    Attributes:
        rows: From the first row of tokens to the one after the last.
        cols: As the rows.
    """

    rows: slice
    cols: slice

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns of tokens."""
        return self.rows.stop - self.rows.start, self.cols.stop - self.cols.start

    def cut(self, values: NDArray[Any], side: int) -> NDArray[Any]:
        """The window of an array (..., H, W) that has `side` x `side` values a token."""
        rows, cols = (slice(side * part.start, side * part.stop) for part in (self.rows, self.cols))
        return np.ascontiguousarray(values[..., rows, cols])

    def paste(self, values: NDArray[Any], whole: NDArray[Any], kept: int) -> None:
        """Write values (..., h, w) of the window to an array (..., H, W) of the map's tokens.

        Of the margin at an edge that is not the map's only `kept` tokens are written.
        """
        rows, cols = (
            _inner(part, tokens, kept)
            for part, tokens in zip((self.rows, self.cols), whole.shape[-2:], strict=True)
        )
        inside = values[
            ...,
            rows.start - self.rows.start : rows.stop - self.rows.start,
            cols.start - self.cols.start : cols.stop - self.cols.start,
        ]
        whole[..., rows, cols] = inside


def stitch(parts: Sequence[tuple[Window, NDArray[Any]]], whole: NDArray[Any]) -> None:
    """Write the values (..., h, w) of windows to an array (..., H, W) of the map's tokens.

    Tokens at the edge of a window were predicted knowing little of what lies beyond, so that they
    never replace what another window is about.
    """
    for kept in (_KEPT, 0):
        for window, values in parts:
            window.paste(values, whole, kept)


def whole_map(shape: tuple[int, ...], scale: NetworkScale) -> Window:
    """The window of all tokens of a network map of (H, W) pixels."""
    height, width = (size // scale.stride for size in shape)
    return Window(slice(0, height), slice(0, width))


def windows_round(matters: NDArray[np.bool_], scale: NetworkScale) -> list[Window]:
    """Small windows that hold all that matters, with a margin.

    Args:
        matters: (H / query_stride, W / query_stride) bool, the query pixels that matter.
        scale: The network's scale.
    """
    side = scale.stride // scale.query_stride
    height, width = (size // side for size in matters.shape)
    tokens = np.asarray(matters.reshape(height, side, width, side).any(axis=(1, 3)))
    box = _box(tokens, slice(0, height), slice(0, width))
    if box is None:
        return []
    tiles = (
        _box(tokens, slice(row, row + TILE), slice(col, col + TILE))
        for row in range(box.rows.start, box.rows.stop, TILE)
        for col in range(box.cols.start, box.cols.stop, TILE)
    )
    return [Window(_widened(t.rows, height), _widened(t.cols, width)) for t in tiles if t]


def _box(tokens: NDArray[np.bool_], rows: slice, cols: slice) -> Window | None:
    """The smallest window round the tokens that matter among some; None if there are none."""
    part = tokens[rows, cols]
    if not part.any():
        return None
    (top, bottom), (left, right) = (
        np.flatnonzero(part.any(axis=axis))[[0, -1]].tolist() for axis in (1, 0)
    )
    return Window(
        slice(rows.start + top, rows.start + bottom + 1),
        slice(cols.start + left, cols.start + right + 1),
    )


def _widened(part: slice, tokens: int) -> slice:
    return slice(max(part.start - MARGIN, 0), min(part.stop + MARGIN, tokens))


def _inner(part: slice, tokens: int, kept: int) -> slice:
    """With `kept` tokens of the margin, along one axis."""
    beyond = MARGIN - kept
    first = part.start and part.start + beyond
    last = part.stop if part.stop == tokens else part.stop - beyond
    return slice(first, last)
