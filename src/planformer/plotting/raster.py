"""The map as an image: floor, heat of the region proposal, margins, unknown space, obstacles."""

from __future__ import annotations

import math

import cv2
import numpy as np
from numpy.typing import NDArray

from planformer.guidance import Region
from planformer.plotting import style
from planformer.plotting.view import View

_THIN_WALLS = 0.6
"""Exponent on the share of a shrunk pixel that is occupied: walls a cell wide stay visible."""


def map_image(
    view: View, radius: float, region: Region | None, *, pixels: int
) -> NDArray[np.float32]:
    """Draw the part of a map that a view shows, in the map's own frame.

    Args:
        view: The part of the map.
        radius: Radius of the robot in metres; its margin round obstacles is shaded.
        region: Its probability is drawn as a heat map on the floor; None for a bare map.
        pixels: Wanted size of the longer side. A smaller part is enlarged by a whole factor.

    Returns:
        (h, w, 3) float32 colours in [0, 1], row 0 at the lowest y.
    """
    grid = view.grid
    shape = image_shape(view.shape, pixels)
    image = np.empty((*shape, 3), np.float32)
    image[:] = style.rgb(style.FLOOR)
    margin = grid.blocked(radius) & ~grid.occupied
    _blend(image, style.rgb(style.MARGIN), resized(view.of(margin), shape))
    if region is not None:
        heat = style.heat_colours()(heat_values(view, region, shape)).astype(np.float32)
        _blend(image, heat[..., :3], heat[..., 3])
    _blend(image, style.rgb(style.UNKNOWN), resized(view.of(grid.unknown), shape))
    known = resized(view.of(grid.occupied & ~grid.unknown), shape) ** _THIN_WALLS
    _blend(image, style.rgb(style.OBSTACLE), known)
    return image


def resized(mask: NDArray[np.bool_], shape: tuple[int, int]) -> NDArray[np.float32]:
    """Share of each pixel of an image of `shape` that a (H, W) bool mask covers, float32."""
    shrinks = shape[0] < mask.shape[0] or shape[1] < mask.shape[1]
    return np.asarray(
        cv2.resize(
            mask.astype(np.float32),
            shape[::-1],
            interpolation=cv2.INTER_AREA if shrinks else cv2.INTER_NEAREST,
        )
    )


def heat_values(view: View, region: Region, shape: tuple[int, int]) -> NDArray[np.float32]:
    """The probabilities between the anchors, (h, w) float32, at the pixels of an image."""
    anchors = view.grid.frame.to_local(region.anchors)
    left, right, bottom, top = view.extent
    at_column = _fractional_index(anchors[0, :, 0], left, right, shape[1])
    at_row = _fractional_index(anchors[:, 0, 1], bottom, top, shape[0])
    columns, rows = np.meshgrid(at_column, at_row)
    values = cv2.remap(
        np.ascontiguousarray(region.probability, np.float32),
        columns,
        rows,
        cv2.INTER_CUBIC,
        borderMode=cv2.BORDER_REPLICATE,
    )
    return np.asarray(np.clip(values, 0.0, 1.0))


def _fractional_index(
    positions: NDArray[np.float64], low: float, high: float, pixels: int
) -> NDArray[np.float32]:
    """Where the centre of each pixel from low to high lies among evenly spaced positions."""
    centres = low + (np.arange(pixels) + 0.5) * ((high - low) / pixels)
    spacing = positions[1] - positions[0] if len(positions) > 1 else 1.0
    return np.asarray((centres - positions[0]) / spacing, np.float32)


def image_shape(shape: tuple[int, int], pixels: int) -> tuple[int, int]:
    """Size of an image of (H, W) cells: the longer side shrunk to `pixels` or a multiple below."""
    longer = max(shape)
    if longer <= pixels:
        factor = pixels // longer
        return shape[0] * factor, shape[1] * factor
    rows, columns = (max(1, math.ceil(side * pixels / longer)) for side in shape)
    return rows, columns


def _blend(
    image: NDArray[np.float32], colour: NDArray[np.float32], opacity: NDArray[np.float32]
) -> None:
    """Lay a colour over the image, in place."""
    image += (colour - image) * opacity[..., None]
