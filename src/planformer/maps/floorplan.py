"""Floor plans by recursive subdivision: corridors, rooms and the doors that join them all."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

WALL = 0.15
"""Thickness of a wall in metres."""

_CORRIDOR_WIDTH = (1.6, 2.3)
_DOOR_WIDTH = (0.9, 1.0)
_SHORTEST_SIDE = 2.6
_LONGEST_SIDE = (4.0, 7.5)
_CORRIDOR_AREA = (80.0, 160.0)
"""Blocks larger than this in m^2 are opened up by a corridor."""
_CORRIDOR_BLOCK_SIDE = 7.0
_EXTRA_DOOR = 0.06
_UNVISITED = 0.1
_TOUCHING = 1e-9


@dataclass(frozen=True)
class Rect:
    """An axis-aligned rectangle in the building's frame, metres."""

    x0: float
    y0: float
    x1: float
    y1: float

    @property
    def width(self) -> float:
        """Extent along x in metres."""
        return self.x1 - self.x0

    @property
    def height(self) -> float:
        """Extent along y in metres."""
        return self.y1 - self.y0

    @property
    def area(self) -> float:
        """Area in square metres."""
        return self.width * self.height

    @property
    def centre(self) -> tuple[float, float]:
        """Centre (x, y) in metres."""
        return (self.x0 + self.x1) / 2, (self.y0 + self.y1) / 2

    def grown(self, by: float) -> Rect:
        """The rectangle with every side moved outwards by `by` metres."""
        return Rect(self.x0 - by, self.y0 - by, self.x1 + by, self.y1 + by)

    def overlaps(self, other: Rect) -> bool:
        """Whether the two share more than an edge."""
        return (
            self.x0 < other.x1 - _TOUCHING
            and other.x0 < self.x1 - _TOUCHING
            and self.y0 < other.y1 - _TOUCHING
            and other.y0 < self.y1 - _TOUCHING
        )

    def contains(self, other: Rect) -> bool:
        """Whether the other lies inside, edges included."""
        outer = self.grown(_TOUCHING)
        return (
            outer.x0 <= other.x0
            and outer.y0 <= other.y0
            and other.x1 <= outer.x1
            and other.y1 <= outer.y1
        )

    def transposed(self) -> Rect:
        """The rectangle with x and y exchanged."""
        return Rect(self.y0, self.x0, self.y1, self.x1)


@dataclass(frozen=True)
class Room:
    """A room or corridor; its walls are centred on the edges of `rect`."""

    rect: Rect
    is_corridor: bool

    @property
    def inside(self) -> Rect:
        """The floor between the walls."""
        return self.rect.grown(-WALL / 2)


@dataclass(frozen=True)
class Door:
    """An opening in the wall between two rooms.

    Attributes:
        opening: The part of the wall that is missing.
        is_vertical: Whether the wall runs along y.
        rooms: Indices of the rooms on its two sides.
        has_leaf: False for an open end between corridors.
    """

    opening: Rect
    is_vertical: bool
    rooms: tuple[int, int]
    has_leaf: bool


@dataclass(frozen=True)
class FloorPlan:
    """Rooms and doors; `visited` tells which rooms a robot has seen."""

    rooms: tuple[Room, ...]
    doors: tuple[Door, ...]
    visited: tuple[bool, ...]


def generate_floor_plan(rng: np.random.Generator, width: float, height: float) -> FloorPlan:
    """Divide a building into rooms round corridors, with doors that make all rooms one network.

    Args:
        rng: Source of randomness.
        width: Extent of the building along x in metres.
        height: Extent of the building along y in metres.
    """
    rooms = tuple(_divide(rng, Rect(0.0, 0.0, width, height), along_x=width >= height))
    walls = _shared_walls(rooms)
    doors = tuple(_make_door(rng, rooms, wall) for wall in _choose_doors(rng, rooms, walls))
    return FloorPlan(rooms, doors, _visit(rng, rooms, doors))


def _divide(rng: np.random.Generator, block: Rect, *, along_x: bool) -> list[Room]:
    """Rooms of a block whose corridor, if the block is large enough for one, runs along x or y.

    Corridors of nested blocks alternate in direction, so each opens into the one outside it.
    """
    if not along_x:
        rooms = _divide(rng, block.transposed(), along_x=True)
        return [Room(room.rect.transposed(), room.is_corridor) for room in rooms]
    if block.area < rng.uniform(*_CORRIDOR_AREA) or block.height < _CORRIDOR_BLOCK_SIDE:
        return [Room(rect, False) for rect in _divide_by_walls(rng, block)]
    corridor_width = rng.uniform(*_CORRIDOR_WIDTH)
    y = block.y0 + (block.height - corridor_width) * rng.uniform(0.36, 0.64)
    corridor = Rect(block.x0, y, block.x1, y + corridor_width)
    lower = Rect(block.x0, block.y0, block.x1, corridor.y0)
    upper = Rect(block.x0, corridor.y1, block.x1, block.y1)
    return [
        Room(corridor, True),
        *_divide(rng, lower, along_x=False),
        *_divide(rng, upper, along_x=False),
    ]


def _divide_by_walls(rng: np.random.Generator, block: Rect) -> list[Rect]:
    """Split across the longer side until every room is short enough."""
    if block.height > block.width:
        return [r.transposed() for r in _divide_by_walls(rng, block.transposed())]
    if block.width <= max(rng.uniform(*_LONGEST_SIDE), 2 * _SHORTEST_SIDE):
        return [block]
    share = max(0.3, _SHORTEST_SIDE / block.width)
    x = block.x0 + block.width * rng.uniform(share, 1.0 - share)
    return [
        *_divide_by_walls(rng, Rect(block.x0, block.y0, x, block.y1)),
        *_divide_by_walls(rng, Rect(x, block.y0, block.x1, block.y1)),
    ]


@dataclass(frozen=True)
class _SharedWall:
    """Where two rooms touch: from `start` to `end` at `position` across."""

    rooms: tuple[int, int]
    is_vertical: bool
    position: float
    start: float
    end: float


def _shared_walls(rooms: Sequence[Room]) -> list[_SharedWall]:
    """Shared walls that are long enough for a door with its frame."""
    edges = np.array([(r.rect.x0, r.rect.y0, r.rect.x1, r.rect.y1) for r in rooms])
    walls = []
    for along, is_vertical in ((0, True), (1, False)):
        low, high = edges[:, along], edges[:, along + 2]
        across_low, across_high = edges[:, 1 - along], edges[:, 3 - along]
        start = np.maximum(across_low[:, None], across_low)
        end = np.minimum(across_high[:, None], across_high)
        touching = np.abs(high[:, None] - low) < _TOUCHING
        for i, j in np.argwhere(touching & (end - start >= _DOOR_WIDTH[1] + 2 * WALL)).tolist():
            walls.append(_SharedWall((i, j), is_vertical, float(high[i]), start[i, j], end[i, j]))
    return walls


def _choose_doors(
    rng: np.random.Generator, rooms: Sequence[Room], walls: Sequence[_SharedWall]
) -> list[_SharedWall]:
    """A random spanning tree of the rooms that prefers corridors, and a few doors more."""
    corridors = [sum(rooms[i].is_corridor for i in wall.rooms) for wall in walls]
    order = sorted(
        range(len(walls)), key=lambda k: (-corridors[k], rng.random())
    )  # Kruskal: openings between corridors, then doors to them, then between rooms
    group = list(range(len(rooms)))
    chosen = []
    for k in order:
        a, b = (group[i] for i in walls[k].rooms)
        if a != b or corridors[k] == 2 or rng.random() < _EXTRA_DOOR:
            chosen.append(walls[k])
            group = [a if g == b else g for g in group]
    return chosen


def _make_door(rng: np.random.Generator, rooms: Sequence[Room], wall: _SharedWall) -> Door:
    is_open_end = all(rooms[i].is_corridor for i in wall.rooms)
    if is_open_end:
        start, end = wall.start + WALL / 2, wall.end - WALL / 2
    else:
        width = rng.uniform(*_DOOR_WIDTH)
        start = rng.uniform(wall.start + WALL, wall.end - WALL - width)
        end = start + width
    across = WALL / 2 + 0.02  # a little more, so that no sliver of wall is left
    opening = Rect(start, wall.position - across, end, wall.position + across)
    if wall.is_vertical:
        opening = opening.transposed()
    return Door(opening, wall.is_vertical, wall.rooms, has_leaf=not is_open_end)


def _visit(
    rng: np.random.Generator, rooms: Sequence[Room], doors: Sequence[Door]
) -> tuple[bool, ...]:
    """Leave out some rooms at dead ends, as if their doors had been shut."""
    visited = [True] * len(rooms)
    for i, room in enumerate(rooms):
        n_doors = sum(i in door.rooms for door in doors)
        if n_doors == 1 and not room.is_corridor and rng.random() < _UNVISITED:
            visited[i] = sum(visited) == 1
    return tuple(visited)
