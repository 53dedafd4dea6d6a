"""What is said about a map, for people and for programs."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from planformer.maps import OccupancyGrid


def map_record(file: Path, grid: OccupancyGrid) -> dict[str, Any]:
    """A map's properties as JSON-compatible values; metres and rad."""
    return {
        "file": str(file),
        "shape": grid.shape,
        "width": grid.width,
        "height": grid.height,
        "resolution": grid.resolution,
        "origin": grid.origin,
        "free": float(grid.free.mean()),
        "occupied": float(grid.occupied.mean()),
        "unknown": float(grid.unknown.mean()),
        "widest_clearance": float(grid.clearance.max()),
    }


def map_facts(file: Path, grid: OccupancyGrid) -> dict[str, str]:
    """A map's properties by name."""
    rows, columns = grid.shape
    x, y, yaw = grid.origin
    return {
        "file": str(file),
        "size": f"{grid.width:g} x {grid.height:g} m, {columns} x {rows} cells",
        "resolution": f"{grid.resolution:g} m",
        "origin": f"({x:g}, {y:g}) m, yaw {yaw:g} rad",
        "free": f"{grid.free.mean():.1%}",
        "occupied": f"{grid.occupied.mean():.1%}",
        "unknown": f"{grid.unknown.mean():.1%}",
        "clearance": f"at most {grid.clearance.max():.2f} m",
    }
