"""Maps and regions as PNG pictures: the first row has the highest y."""

from __future__ import annotations

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
    """An (H, W) bool mask as an 8-bit grey PNG, 255 where true."""
    return _png(mask.astype(np.uint8) * np.uint8(255))


def _png(levels: NDArray[np.uint8]) -> bytes:
    done, data = cv2.imencode(".png", levels[::-1], _FAST)
    assert done  # an array of bytes can always be encoded
    return bytes(data)
