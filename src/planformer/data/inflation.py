"""Inflation of obstacles by a disc with NumPy alone, for training without the planning core."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

_RADIUS_TOLERANCE = 1e-6


def inflate(occupied: NDArray[np.bool_], resolution: float, radius: float) -> NDArray[np.bool_]:
    """Cells that a disc robot cannot occupy: equal to `OccupancyGrid.blocked(radius)`.

    A cell is blocked when its centre is at most `radius` away from the centre of an occupied
    cell; the ring of cells just outside the map counts as occupied. The cost grows with the
    radius: meant for robots of a few cells.

    Args:
        occupied: (H, W) bool.
        resolution: Side of a cell in metres.
        radius: Radius of the robot in metres.

    Returns:
        (H, W) bool.
    """
    reach, half_widths = _disc(resolution, radius)
    rows, columns = occupied.shape
    # The ring is one cell wide: whatever lies further out is farther than the ring.
    padded = np.pad(np.pad(occupied, 1, constant_values=True), reach)
    blocked = np.zeros((rows, columns), bool)
    for shift, half in zip(range(-reach, reach + 1), half_widths, strict=True):
        first = reach + 1 + shift
        band = padded[first : first + rows]
        for column in range(reach + 1 - half, reach + 2 + half):
            blocked |= band[:, column : column + columns]
    return blocked


def _disc(resolution: float, radius: float) -> tuple[int, list[int]]:
    """The disc's reach in rows and, from the lowest row up, its half width in columns.

    Computed in float32 and with the tolerance of `OccupancyGrid`, so that both agree on cells
    whose distance is the radius.
    """
    limit = np.float32(radius * (1.0 + _RADIUS_TOLERANCE))
    bound = int(radius / resolution) + 1
    offsets = np.arange(-bound, bound + 1)
    squared = (offsets[:, None] ** 2 + offsets[None, :] ** 2).astype(np.float32)
    inside = np.sqrt(squared) * np.float32(resolution) <= limit
    reach = int(inside[:, bound].sum()) // 2
    return reach, [int(n) // 2 for n in inside.sum(axis=1)[bound - reach : bound + reach + 1]]
