"""Maps and regions as PNG pictures: the first row has the highest y."""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import NDArray

from planformer.maps import OccupancyGrid

OCCUPIED, UNKNOWN, FREE = 0, 127, 255
_FAST = [cv2.IMWRITE_PNG_COMPRESSION, 1]


def map_png(grid: OccupancyGrid) -> bytes:
    """A map as an 8-bit grey PNG."""
    levels = np.where(grid.occupied, OCCUPIED, FREE).astype(np.uint8)
    levels[grid.unknown] = UNKNOWN
    return _png(levels)


def mask_png(mask: NDArray[np.bool_]) -> bytes:
    """An (H, W) bool mask as a black and white PNG, white where true."""
    # One bit a pixel: encoded in a fifth of the time, which each answer with a region waits for.
    return _png(mask.view(np.uint8), [cv2.IMWRITE_PNG_BILEVEL, 1])


def _png(levels: NDArray[np.uint8], options: Sequence[int] = ()) -> bytes:
    done, data = cv2.imencode(".png", levels[::-1], [*_FAST, *options])
    assert done  # an array of bytes can always be encoded
    return bytes(data)
