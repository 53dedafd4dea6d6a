"""A map that the service offers, named by its content."""

from __future__ import annotations

import hashlib
import struct
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from planformer.maps import OccupancyGrid
from planformer.serve.responses import MapInfo, MapSource


@dataclass(frozen=True, eq=False)
class ServedMap:
    """A map with its name.

    Attributes:
        name: What people call it.
        grid: The map.
        source: How it was generated; None for others.
    """

    name: str
    grid: OccupancyGrid
    source: MapSource | None = None

    @cached_property
    def info(self) -> MapInfo:
        """What there is to say of the map."""
        grid = self.grid
        rows, columns = grid.shape
        return MapInfo(
            id=content_id(grid),
            name=self.name,
            rows=rows,
            columns=columns,
            resolution=grid.resolution,
            origin=grid.origin,
            width=grid.width,
            height=grid.height,
            occupied=float(grid.occupied.mean()),
            source=self.source,
        )


def content_id(grid: OccupancyGrid) -> str:
    """16 hex digits of a SHA-256 over the cells, the resolution and the origin."""
    digest = hashlib.sha256(struct.pack("<2Q4d", *grid.shape, grid.resolution, *grid.origin))
    for cells in (grid.occupied, grid.unknown):
        digest.update(np.packbits(cells).tobytes())
    return digest.hexdigest()[:16]
