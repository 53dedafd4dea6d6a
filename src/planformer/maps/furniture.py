"""Furniture for floor plans, placed so that a robot can reach every part of a room."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np

from planformer.maps.floorplan import Door, FloorPlan, Rect, Room

_AISLE = 0.8
"""Way left free round furniture in the middle of a room in metres."""
_GAP = 0.65
"""Least gap between pieces of furniture in metres: no corner of a room is shut off."""
_CHAIR_ZONE = 0.5
_DOOR_ZONE = 1.0
_LEAF = 0.06
_LEAF_SHARE = 0.35
_LEG = 0.08
_ATTEMPTS = 6


@dataclass(frozen=True)
class Item:
    """Something solid at the height of the sensor.

    Attributes:
        centre: (x, y) in the building's frame in metres.
        size: Extent along its own axes in metres.
        angle: Counter-clockwise rotation in rad.
    """

    centre: tuple[float, float]
    size: tuple[float, float]
    angle: float = 0.0

    @classmethod
    def from_rect(cls, rect: Rect) -> Item:
        """The item that fills an axis-aligned rectangle."""
        return cls(rect.centre, (rect.width, rect.height))


@dataclass
class _Floor:
    """A room being furnished; lengths in metres, `side` 0 to 3 is bottom, right, top, left."""

    rng: np.random.Generator
    inside: Rect
    kept_free: list[Rect]
    taken: list[Rect] = field(default_factory=list)
    items: list[Item] = field(default_factory=list)

    def is_free(self, rect: Rect, gap: float) -> bool:
        blocked = any(rect.overlaps(zone) for zone in self.kept_free)
        grown = rect.grown(gap)
        return (
            self.inside.contains(rect)
            and not blocked
            and not any(grown.overlaps(other) for other in self.taken)
        )

    def take(self, rect: Rect, gap: float) -> bool:
        """Reserve a rectangle if it is free."""
        free = self.is_free(rect, gap)
        if free:
            self.taken.append(rect)
        return free

    def against_wall(self, side: int, length: float, depth: float) -> Rect | None:
        """Reserve a place along a wall, opposite furniture an aisle away."""
        room = self.inside
        span = room.width if side % 2 == 0 else room.height
        breadth = room.height if side % 2 == 0 else room.width
        if span < length or breadth < depth + _AISLE:
            return None
        for _ in range(_ATTEMPTS):
            # Corners are popular.
            start = (span - length) * float(np.clip(self.rng.uniform(-0.3, 1.3), 0.0, 1.0))
            rect = _along_wall(room, side, start, length, depth)
            if self.take(rect, _GAP):
                return rect
        return None

    def in_the_middle(self, length: float, depth: float) -> Rect | None:
        """Reserve a place with an aisle all round."""
        width, height = (
            (length, depth) if self.inside.width > self.inside.height else (depth, length)
        )
        room = self.inside.grown(-_AISLE)
        if room.width < width or room.height < height:
            return None
        for _ in range(_ATTEMPTS):
            x = room.x0 + (room.width - width) * self.rng.uniform(0.25, 0.75)
            y = room.y0 + (room.height - height) * self.rng.uniform(0.25, 0.75)
            rect = Rect(x, y, x + width, y + height)
            if self.take(rect, _AISLE):
                return rect
        return None


def furnish(rng: np.random.Generator, plan: FloorPlan) -> list[Item]:
    """Furniture and open door leaves for every visited room.

    Args:
        rng: Source of randomness.
        plan: The floor plan.
    """
    items = []
    for index, room in enumerate(plan.rooms):
        if not plan.visited[index]:
            continue
        doors = [door for door in plan.doors if index in door.rooms]
        floor = _Floor(rng, room.inside, [_door_zone(door) for door in doors])
        if not room.is_corridor:  # a leaf that opened into a corridor would close it
            _open_leaves(floor, doors, index)
        for arrange in _choose_arrangements(rng, room):
            arrange(floor)
        items += floor.items
    return items


def _choose_arrangements(
    rng: np.random.Generator, room: Room
) -> Sequence[Callable[[_Floor], None]]:
    if room.is_corridor:
        return (_cabinets,)
    area = room.inside.area
    if area < 8.0:
        kinds: tuple[tuple[Callable[[_Floor], None], ...], ...] = ((_shelves,), (_desks, _cabinets))
    elif area < 20.0:
        kinds = (
            (_desks, _shelves),
            (_shelves, _desks),
            (_meeting, _cabinets),
            (_bedroom, _shelves),
            (_storage,),
        )
    else:
        kinds = (
            (_islands, _desks, _shelves),
            (_meeting, _shelves, _cabinets),
            (_living, _cabinets),
            (_storage, _cabinets),
            (_desks, _islands),
        )
    return kinds[rng.integers(len(kinds))]


def _door_zone(door: Door) -> Rect:
    """The floor on both sides of a door that furniture leaves free."""
    opening = door.opening.transposed() if door.is_vertical else door.opening
    y = (opening.y0 + opening.y1) / 2
    zone = Rect(opening.x0 - 0.1, y - _DOOR_ZONE, opening.x1 + 0.1, y + _DOOR_ZONE)
    return zone.transposed() if door.is_vertical else zone


def _open_leaves(floor: _Floor, doors: Sequence[Door], room: int) -> None:
    """The leaves of some doors, standing open into the room clear of its other doors."""
    for door in doors:
        if door.has_leaf and floor.rng.random() < _LEAF_SHARE:
            leaf = _open_leaf(floor.rng, door, into=1.0 if room == door.rooms[1] else -1.0)
            x, y = leaf.centre
            half = leaf.size[0] / 2
            swept = Rect(x - half, y - half, x + half, y + half)
            others = (_door_zone(other) for other in doors if other is not door)
            if not any(swept.overlaps(zone) for zone in others):
                floor.items.append(leaf)
                floor.kept_free.append(swept.grown(_GAP))


def _open_leaf(rng: np.random.Generator, door: Door, into: float) -> Item:
    """A leaf open into the room above or right of the wall (1), or below or left of it (-1)."""
    opening = door.opening.transposed() if door.is_vertical else door.opening
    width, y = opening.width, (opening.y0 + opening.y1) / 2
    at_start = rng.random() < 0.5
    hinge = opening.x0 if at_start else opening.x1
    swing = rng.uniform(math.radians(85), math.radians(120))
    angle = into * (swing if at_start else math.pi - swing)
    x = hinge + 0.5 * width * math.cos(angle)
    y += 0.5 * width * math.sin(angle)
    if door.is_vertical:
        x, y, angle = y, x, math.pi / 2 - angle
    return Item((x, y), (width, _LEAF), angle)


def _along_wall(room: Rect, side: int, start: float, length: float, depth: float) -> Rect:
    if side == 0:
        return Rect(room.x0 + start, room.y0, room.x0 + start + length, room.y0 + depth)
    if side == 2:
        return Rect(room.x0 + start, room.y1 - depth, room.x0 + start + length, room.y1)
    return _along_wall(room.transposed(), (side + 1) % 4, start, length, depth).transposed()


def _shelves(floor: _Floor) -> None:
    """Shelves along one or two walls."""
    for side in floor.rng.permutation(4)[: floor.rng.integers(1, 3)].tolist():
        length, depth = floor.rng.uniform(0.8, 3.2), floor.rng.uniform(0.3, 0.5)
        rect = floor.against_wall(side, length, depth)
        if rect is not None:
            floor.items.append(Item.from_rect(rect))


def _cabinets(floor: _Floor) -> None:
    """A few narrow things along the walls, more in a longer room."""
    rng, room = floor.rng, floor.inside
    for _ in range(int(rng.integers(0, 2 + int(max(room.width, room.height) / 5)))):
        length, depth = rng.uniform(0.4, 1.2), rng.uniform(0.25, 0.45)
        rect = floor.against_wall(int(rng.integers(4)), length, depth)
        if rect is not None:
            floor.items.append(Item.from_rect(rect))


def _desks(floor: _Floor) -> None:
    """Desks along the walls, each with a chair."""
    for side in floor.rng.integers(0, 4, 1 + int(floor.inside.area / 5)).tolist():
        depth = floor.rng.uniform(0.7, 0.8)
        place = floor.against_wall(side, floor.rng.uniform(1.2, 1.8), depth + _CHAIR_ZONE)
        if place is not None:
            room = place.transposed() if side % 2 else place
            desk = _along_wall(place, side, 0.0, room.width, depth)
            _add_table(floor, desk)
            _add_chair(floor, _in_front(desk, side, 0.2))


def _meeting(floor: _Floor) -> None:
    """A table in the middle with chairs along its sides."""
    room = floor.inside
    longest = max(room.width, room.height) - 2 * _AISLE - 1.2
    shortest = min(room.width, room.height) - 2 * _AISLE - 1.2
    if longest < 1.2 or shortest < 0.7:
        return
    place = floor.in_the_middle(
        min(longest, floor.rng.uniform(1.8, 5.0)) + 1.2, min(shortest, 1.3) + 1.2
    )
    if place is None:
        return
    table = place.grown(-0.6)
    _add_table(floor, table)
    is_wide = table.width > table.height
    along = table if is_wide else table.transposed()
    for x in np.arange(along.x0 + 0.4, along.x1 - 0.3, 0.75).tolist():
        for y in (along.y0 - 0.3, along.y1 + 0.3):
            if floor.rng.random() < 0.8:
                _add_chair(floor, (x, y) if is_wide else (y, x))


def _islands(floor: _Floor) -> None:
    """Pairs of desks back to back, with chairs on both sides."""
    for _ in range(1 + int(floor.inside.area / 16)):
        place = floor.in_the_middle(floor.rng.choice([1.6, 3.2]), 1.6 + 1.0)
        if place is None:
            continue
        is_wide = floor.inside.width > floor.inside.height
        along = place if is_wide else place.transposed()
        desks = Rect(along.x0, along.y0 + 0.5, along.x1, along.y1 - 0.5)
        _add_table(floor, desks if is_wide else desks.transposed())
        for x in np.arange(desks.x0 + 0.8, desks.x1, 1.6).tolist():
            for y in (desks.y0 - 0.25, desks.y1 + 0.25):
                _add_chair(floor, (x, y) if is_wide else (y, x))


def _storage(floor: _Floor) -> None:
    """Parallel shelves across the room, and shelves along the walls."""
    room = floor.inside
    is_wide = room.width > room.height
    along = room if is_wide else room.transposed()
    for x in np.arange(along.x0 + 1.2, along.x1 - 1.5, 1.7).tolist():
        rect = Rect(x, along.y0 + 0.9, x + 0.5, along.y1 - 0.9)
        rect = rect if is_wide else rect.transposed()
        if min(rect.width, rect.height) > 0.4 and floor.take(rect, _AISLE):
            floor.items.append(Item.from_rect(rect))
    _shelves(floor)


def _bedroom(floor: _Floor) -> None:
    """A bed with its head to a wall, and a wardrobe."""
    side = int(floor.rng.integers(4))
    bed = floor.against_wall(side, floor.rng.uniform(0.9, 1.6), 2.0)
    if bed is not None:
        floor.items.append(Item.from_rect(bed))
    wardrobe = floor.against_wall((side + 2) % 4, floor.rng.uniform(1.0, 2.2), 0.6)
    if wardrobe is not None:
        floor.items.append(Item.from_rect(wardrobe))


def _living(floor: _Floor) -> None:
    """Sofa and low table, dining table, shelves."""
    sofa = floor.against_wall(int(floor.rng.integers(4)), floor.rng.uniform(1.6, 2.4), 0.85)
    if sofa is not None:
        floor.items.append(Item.from_rect(sofa))
    _meeting(floor)
    low_table = floor.in_the_middle(0.9, 0.5)
    if low_table is not None:
        floor.items.append(Item.from_rect(low_table))
    _shelves(floor)


def _in_front(rect: Rect, side: int, distance: float) -> tuple[float, float]:
    """The point `distance` in front of furniture that stands against a wall."""
    x, y = rect.centre
    return (
        (x, rect.y1 + distance),
        (rect.x0 - distance, y),
        (x, rect.y0 - distance),
        (rect.x1 + distance, y),
    )[side]


def _add_table(floor: _Floor, rect: Rect) -> None:
    """A table: solid, or its four legs and sometimes a drawer unit."""
    if floor.rng.random() < 0.4:
        floor.items.append(Item.from_rect(rect))
        return
    legs = rect.grown(-_LEG)
    for x in (legs.x0, legs.x1):
        for y in (legs.y0, legs.y1):
            floor.items.append(Item((x, y), (_LEG, _LEG)))
    if floor.rng.random() < 0.4:
        floor.items.append(Item((legs.x0 + 0.2, legs.centre[1]), (0.4, legs.height)))


def _add_chair(floor: _Floor, centre: tuple[float, float]) -> None:
    """A chair, turned and pushed about a little: one blob, or four legs."""
    rng = floor.rng
    x, y = (float(v + rng.uniform(-0.08, 0.08)) for v in centre)
    seat = Rect(x - 0.2, y - 0.2, x + 0.2, y + 0.2)
    if not floor.inside.contains(seat) or any(seat.overlaps(zone) for zone in floor.kept_free):
        return
    angle = float(rng.uniform(-0.4, 0.4))
    if rng.random() < 0.5:
        floor.items.append(Item((x, y), (0.36, 0.36), angle))
        return
    c, s = 0.2 * math.cos(angle), 0.2 * math.sin(angle)
    for dx, dy in ((c, s), (-s, c), (-c, -s), (s, -c)):
        floor.items.append(Item((x + dx, y + dy), (0.05, 0.05)))
