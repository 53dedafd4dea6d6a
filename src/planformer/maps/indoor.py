"""Indoor maps: floor plans of offices and flats as a robot's SLAM would map them."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from planformer.errors import InvalidParameter
from planformer.geometry import Frame
from planformer.maps._drawing import fill_box
from planformer.maps._generation import Seed, grid_shape, random_generator, require_extent
from planformer.maps.floorplan import FloorPlan, generate_floor_plan
from planformer.maps.furniture import Item, furnish
from planformer.maps.grid import OccupancyGrid
from planformer.maps.sensor import observe

SMALLEST = 6.0
COARSEST = 0.1
_ROTATED = 0.4
_LARGEST_ROTATION = math.radians(3.0)
_LARGEST_MARGIN = 0.08
_WINDOW = 0.12


def generate_indoor(
    seed: Seed,
    *,
    width: float = 24.0,
    height: float = 24.0,
    resolution: float = 0.05,
) -> OccupancyGrid:
    """Generate an indoor map that looks as if a robot had made it.

    Rooms round corridors (recursive subdivision), walls of 0.15 m, doors of 0.9 to 1.0 m,
    furniture, and what a laser scanner makes of it: ragged surfaces a cell or two thick, speckles,
    rays through windows, unknown space behind walls, inside cupboards and in rooms never entered,
    the whole sometimes turned by up to 3 degrees. Unknown cells are occupied. All rooms entered
    are connected.

    Args:
        seed: Integer >= 0 or NumPy Generator; the same seed gives the same map.
        width: Extent along x in metres, at least 6 m.
        height: Extent along y in metres, at least 6 m.
        resolution: Side of a cell in metres, at most 0.1 m so that doors stay open.

    Returns:
        The map, with its origin at (0, 0).

    Raises:
        InvalidParameter: A size or the seed is out of range.
    """
    rng = random_generator(seed)
    shape = grid_shape(width, height, resolution)
    require_extent("an indoor map", width, height, SMALLEST)
    if resolution > COARSEST:
        raise InvalidParameter(
            f"an indoor map needs a resolution <= {COARSEST} m; got {resolution}"
        )
    frame, building = _place_building(rng, width, height)
    plan = generate_floor_plan(rng, *building)
    free = _draw(plan, furnish(rng, plan), frame, shape, resolution)
    occupied, unknown = observe(rng, free, resolution)
    for ray in _rays_through_windows(rng, plan, building):
        for cells in (occupied, unknown):
            _fill(cells, resolution, frame, item=ray, value=False)
    return OccupancyGrid(occupied, resolution, unknown=unknown)


def _place_building(
    rng: np.random.Generator, width: float, height: float
) -> tuple[Frame, tuple[float, float]]:
    """Frame of the building's lower-left corner on the map, and the building's extent."""
    yaw = rng.uniform(-_LARGEST_ROTATION, _LARGEST_ROTATION) if rng.random() < _ROTATED else 0.0
    x, y = (side * (1.0 - 2.0 * rng.uniform(0.02, _LARGEST_MARGIN)) for side in (width, height))
    # Shrink so that the turned building still fits.
    shrink = 1.0 / (math.cos(yaw) + max(x / y, y / x) * abs(math.sin(yaw)))
    x, y = x * shrink, y * shrink
    centred = Frame(width / 2, height / 2, yaw).to_world((-x / 2, -y / 2))
    return Frame(centred[0], centred[1], yaw), (x, y)


def _rays_through_windows(
    rng: np.random.Generator, plan: FloorPlan, building: tuple[float, float]
) -> list[Item]:
    """Thin rays that left the building through windows, as laser beams do."""
    rays = []
    for room, seen in zip(plan.rooms, plan.visited, strict=True):
        rect = room.rect
        for side, at_edge in (
            (-1.0, rect.y0 == 0.0),
            (1.0, math.isclose(rect.y1, building[1])),
        ):
            if seen and at_edge and rng.random() < _WINDOW:
                y = rect.y0 if side < 0 else rect.y1
                rays += _fan(rng, rect.x0 + rng.uniform(0.3, 0.7) * rect.width, y, side)
    return rays


def _fan(rng: np.random.Generator, x: float, y: float, side: float) -> list[Item]:
    """Rays from a scanner inside through a window about (x, y), above (side 1) or below (-1)."""
    scanner_x, scanner_y = x + rng.uniform(-1.0, 1.0), y - side * rng.uniform(0.8, 2.0)
    rays = []
    for at in np.linspace(x - 0.5, x + 0.5, int(rng.integers(6, 14))).tolist():
        angle = math.atan2(y - scanner_y, at - scanner_x)
        length = rng.uniform(0.3, 3.0)
        reach = length / 2 - 0.2  # from just inside the wall
        centre = (at + reach * math.cos(angle), y + reach * math.sin(angle))
        rays.append(Item(centre, (length, 0.0), angle))
    return rays


def _draw(
    plan: FloorPlan,
    items: list[Item],
    frame: Frame,
    shape: tuple[int, int],
    resolution: float,
) -> NDArray[np.bool_]:
    """(H, W) bool: the true free space."""
    free = np.zeros(shape, bool)
    visited = [room.inside for room, seen in zip(plan.rooms, plan.visited, strict=True) if seen]
    doors = [door.opening for door in plan.doors if all(plan.visited[i] for i in door.rooms)]
    for rect in (*visited, *doors):
        _fill(free, resolution, frame, item=Item.from_rect(rect), value=True)
    for item in items:
        _fill(free, resolution, frame, item=item, value=False)
    return free


def _fill(
    free: NDArray[np.bool_], resolution: float, frame: Frame, *, item: Item, value: bool
) -> None:
    x, y = frame.to_world(item.centre).tolist()
    # At least a cell in each direction, or a thin leaf would fall between the cell centres.
    size = (max(item.size[0], resolution), max(item.size[1], resolution))
    angle = item.angle + frame.yaw
    fill_box(free, resolution, centre=(x, y), size=size, angle=angle, value=value)
