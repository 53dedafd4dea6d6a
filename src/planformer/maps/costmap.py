"""Costmaps as Nav2 has them: values, repair of the start, and what becomes of a proposed region.

Everything here is a function of its arguments and knows no ROS. Costs are those of nav2_costmap_2d:
0 free to 252 expensive, 253 inscribed (a robot whose centre is here touches an obstacle), 254
lethal (an obstacle), 255 unknown. A costmap is inflated already: whoever plans on it plans for a
robot without extent.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from planformer.errors import (
    GoalOccupied,
    GoalOutsideMap,
    InvalidMap,
    InvalidParameter,
    StartOccupied,
    StartOutsideMap,
)
from planformer.maps._validation import checked_origin, checked_resolution
from planformer.maps.grid import OccupancyGrid

DEAREST, INSCRIBED, LETHAL, UNKNOWN = 252, 253, 254, 255
"""Costs with a meaning of their own; all up to DEAREST can be driven through."""

MAX_CELLS = 2**26
"""Larger maps are refused: 8192 x 8192 cells, a square of 400 m at 0.05 m."""

_NAMES = {INSCRIBED: "inscribed", LETHAL: "lethal", UNKNOWN: "unknown"}
_MARGIN = math.sqrt(0.5)
"""In cells: as far as a cell's centre can be from a point in it."""


@dataclass(frozen=True, init=False, repr=False, eq=False)
class Costmap:
    """An immutable costmap with its place in the world.

    Attributes:
        costs: (H, W) uint8, read-only; row 0 = lowest y of the map's own frame.
        resolution: Side of a cell in metres.
        origin: World pose (x, y, yaw) of the lower-left corner of cell (0, 0), in metres and rad.

    Args:
        costs: (H, W) whole numbers from 0 to 255.
        resolution: Side of a cell in metres, finite and positive.
        origin: (x, y) or (x, y, yaw).

    Raises:
        InvalidMap: The array, the resolution or the origin breaks these rules, or there are more
            than MAX_CELLS cells.
    """

    costs: NDArray[np.uint8]
    resolution: float
    origin: tuple[float, float, float]

    def __init__(
        self,
        costs: ArrayLike,
        resolution: float = 0.05,
        origin: Sequence[float] = (0.0, 0.0),
    ) -> None:
        values = np.asarray(costs)
        if values.ndim != 2 or values.size == 0:
            raise InvalidMap(f"costs must be a non-empty (H, W) array; got shape {values.shape}")
        if values.size > MAX_CELLS:
            raise InvalidMap(f"a costmap has at most {MAX_CELLS} cells; got {values.size}")
        cells = np.array(_checked_values(values, 0, 255), dtype=np.uint8, order="C")
        cells.setflags(write=False)
        object.__setattr__(self, "costs", cells)
        object.__setattr__(self, "resolution", checked_resolution(resolution))
        object.__setattr__(self, "origin", checked_origin(origin))

    @classmethod
    def from_nav2(
        cls,
        values: ArrayLike,
        width: int,
        height: int,
        resolution: float,
        origin: Sequence[float] = (0.0, 0.0),
    ) -> Costmap:
        """Make a costmap from the cells of a nav2_costmap_2d::Costmap2D.

        Args:
            values: width * height costs, row by row from the origin.
            width: Number of columns.
            height: Number of rows.
            resolution: Side of a cell in metres.
            origin: (x, y) or (x, y, yaw) of the lower-left corner.

        Raises:
            InvalidMap: The number of values or anything else is wrong.
        """
        return cls(_as_rows(values, width, height), resolution, origin)

    @classmethod
    def from_published(
        cls,
        values: ArrayLike,
        width: int,
        height: int,
        resolution: float,
        origin: Sequence[float] = (0.0, 0.0),
    ) -> Costmap:
        """Make a costmap from a nav_msgs/OccupancyGrid that a Nav2 costmap publishes.

        There -1 is unknown, 99 inscribed, 100 lethal, and 1 to 98 stand for the costs between: each
        becomes the lowest of those that it stands for.

        Arguments and errors are those of `from_nav2`.
        """
        return cls(costs_from_published(_as_rows(values, width, height)), resolution, origin)

    @classmethod
    def from_grid(cls, grid: OccupancyGrid) -> Costmap:
        """Make a costmap of a plain map: unknown, lethal or free, nothing is inflated."""
        costs = np.where(grid.occupied, LETHAL, 0).astype(np.uint8)
        costs[grid.unknown] = UNKNOWN
        return cls(costs, grid.resolution, grid.origin)

    @cached_property
    def grid(self) -> OccupancyGrid:
        """The map for networks and planners: closed from INSCRIBED on. Plan with radius 0."""
        return OccupancyGrid(self.closed, self.resolution, self.origin, self.costs == UNKNOWN)

    def to_published(self) -> NDArray[np.int8]:
        """(H * W,) int8 values as a Nav2 costmap publishes them, see `from_published`."""
        return _PUBLISHED[self.costs].ravel()

    @property
    def closed(self) -> NDArray[np.bool_]:
        """(H, W) bool, the cells in which the robot's centre must not be."""
        return np.asarray(self.costs >= INSCRIBED)

    def with_costs(self, costs: ArrayLike) -> Costmap:
        """Other costs in the same place."""
        return Costmap(costs, self.resolution, self.origin)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Costmap):
            return NotImplemented
        return (
            self.resolution == other.resolution
            and self.origin == other.origin
            and np.array_equal(self.costs, other.costs)
        )

    def __hash__(self) -> int:
        return hash((self.costs.shape, self.resolution, self.origin))

    def __repr__(self) -> str:
        rows, columns = self.costs.shape
        x, y, yaw = self.origin
        return (
            f"Costmap({columns} x {rows} cells, resolution={self.resolution:g}, "
            f"origin=({x:g}, {y:g}, {yaw:g}), closed={self.closed.mean():.1%})"
        )


def costs_from_published(values: ArrayLike) -> NDArray[np.uint8]:
    """Costs of the values -1 and 0 to 100 that a Nav2 costmap publishes; any shape.

    Raises:
        InvalidMap: A value is something else.
    """
    return _COSTS[_checked_values(values, -1, 100).astype(np.int16)]


def with_patch(costmap: Costmap, values: ArrayLike, column: int, row: int) -> Costmap:
    """Replace a rectangle of costs, as a map_msgs/OccupancyGridUpdate does.

    Args:
        costmap: The costmap so far.
        values: (h, w) costs.
        column: Column of the rectangle's lowest cell, the message's x.
        row: Row of the rectangle's lowest cell, the message's y.

    Raises:
        InvalidMap: The rectangle does not lie on the map, or a cost is no cost.
    """
    patch = _checked_values(values, 0, 255)
    rows, columns = costmap.costs.shape
    height, width = patch.shape if patch.ndim == 2 else (-1, -1)
    if not (0 <= row <= row + height <= rows and 0 <= column <= column + width <= columns):
        raise InvalidMap(
            f"an update of {width} x {height} cells at column {column}, row {row} does not lie on "
            f"a costmap of {columns} x {rows} cells"
        )
    costs = costmap.costs.copy()
    costs[row : row + height, column : column + width] = patch
    return costmap.with_costs(costs)


def with_unknown_free(costmap: Costmap) -> Costmap:
    """Open the unknown cells, for robots that may explore (Nav2's allow_unknown)."""
    return costmap.with_costs(np.where(costmap.costs == UNKNOWN, 0, costmap.costs))


def inflated(costmap: Costmap, radius: float) -> Costmap:
    """Make passable cells inscribed where a disc would touch a closed cell or leave the map.

    Planning a point on the result is the same as planning a disc on the costmap.

    Args:
        costmap: A costmap, a plain map's for example.
        radius: Radius of the robot, or what the costmap's own inflation lacks of it, in metres.

    Raises:
        InvalidParameter: The radius is negative or not finite.
    """
    blocked = costmap.grid.blocked(radius)
    return costmap.with_costs(np.where(blocked & ~costmap.closed, INSCRIBED, costmap.costs))


def with_way_out(costmap: Costmap, start: Sequence[float], reach: float) -> Costmap:
    """Let a robot leave that stands too close to an obstacle.

    Inscribed cells become passable in a disc round the start that just reaches the nearest passable
    cell; lethal and unknown cells stay closed. A start in passable space changes nothing.

    Args:
        costmap: The costmap, inflated.
        start: (x, y, ...) in metres in the world frame.
        reach: How far from the start the passable cell may be, in metres.

    Raises:
        StartOutsideMap: The start is not on the map.
        StartOccupied: It is in a lethal or unknown cell, or too far from a passable one.
    """
    grid, cost = costmap.grid, _cost_at(start, costmap)
    if cost is None:
        raise StartOutsideMap(_outside("start", start, grid))
    if cost < INSCRIBED:
        return costmap
    nearest = grid.nearest_free(start[:2])
    distance = math.inf if nearest is None else math.dist(nearest, start[:2])
    if cost != INSCRIBED or distance > reach:
        raise StartOccupied(_closed("start", start, cost, nearest), nearest)
    disc = _disc(grid, start, distance + _MARGIN * grid.resolution)
    opened = disc & (costmap.costs == INSCRIBED)
    return costmap.with_costs(np.where(opened, DEAREST, costmap.costs))


def check_goal(costmap: Costmap, goal: Sequence[float]) -> None:
    """Check that a robot could stand at a goal, (x, y, ...) in metres in the world frame.

    Raises:
        GoalOutsideMap: The goal is not on the map.
        GoalOccupied: It is in an inscribed, lethal or unknown cell. Nothing is opened here: nobody
            forces the robot to go there.
    """
    cost = _cost_at(goal, costmap)
    if cost is None:
        raise GoalOutsideMap(_outside("goal", goal, costmap.grid))
    if cost >= INSCRIBED:
        nearest = costmap.grid.nearest_free(goal[:2])
        raise GoalOccupied(_closed("goal", goal, cost, nearest), nearest)


def restricted(
    costmap: Costmap,
    mask: ArrayLike,
    start: Sequence[float],
    goal: Sequence[float],
    keep: float = 0.0,
) -> Costmap:
    """Close a costmap outside a region, for a planner that knows nothing of regions.

    Outside becomes inscribed, unknown cells included: no planner puts the robot's centre there.
    Lethal would shrink the region by the robot's footprint. Lethal cells stay lethal, because a
    footprint inside the region may reach them. Inside, nothing changes.

    Args:
        costmap: The costmap.
        mask: (H, W), true inside the region.
        start: (x, y, ...) in metres in the world frame.
        goal: As the start.
        keep: Cells whose centre is this close [m] to start or goal, and the cells of start and goal
            themselves, stay as they are.

    Raises:
        InvalidMap: The mask has another shape than the costmap.
        InvalidParameter: The radius is negative or not finite.
    """
    if not (math.isfinite(keep) and keep >= 0.0):
        raise InvalidParameter(f"keep must be finite and >= 0 m; got {keep}")
    kept = _checked_mask(mask, costmap).copy()
    grid = costmap.grid
    for state in (start, goal):
        kept |= _disc(grid, state, keep)
        if grid.contains(state[:2]):
            kept[tuple(grid.to_rc(state[:2]))] = True
    stays = kept | (costmap.costs == LETHAL)
    return costmap.with_costs(np.where(stays, costmap.costs, INSCRIBED))


def fallback_reason(
    costmap: Costmap, mask: ArrayLike, start: Sequence[float], goal: Sequence[float]
) -> str | None:
    """Why to plan on the whole costmap and not inside a region; None for a region that serves.

    A region is of no use if it was made for a map of another size, or does not connect start and
    goal through passable cells. (That it does promises nothing to a car, which needs room to turn.)

    Args:
        costmap: The costmap.
        mask: (H, W), true inside the region.
        start: (x, y, ...) in metres in the world frame, on the map.
        goal: As the start.
    """
    try:
        region = _checked_mask(mask, costmap)
    except InvalidMap as error:
        return str(error)
    import cv2

    free = region & ~costmap.closed
    _, parts = cv2.connectedComponents(free.view(np.uint8), connectivity=4, ltype=cv2.CV_32S)
    (r0, c0), (r1, c1) = costmap.grid.to_rc([start[:2], goal[:2]])
    if parts[r0, c0] != 0 and parts[r0, c0] == parts[r1, c1]:
        return None
    return "the region does not connect start and goal"


def _checked_values(values: ArrayLike, lowest: int, highest: int) -> NDArray[np.integer]:
    array = np.asarray(values)
    if array.dtype.kind not in "iu" or not np.all((array >= lowest) & (array <= highest)):
        raise InvalidMap(f"the values of this map must be whole, from {lowest} to {highest}")
    return array


def _checked_mask(mask: ArrayLike, costmap: Costmap) -> NDArray[np.bool_]:
    region = np.ascontiguousarray(mask, dtype=np.bool_)
    if region.shape != costmap.costs.shape:
        raise InvalidMap(
            f"the region has shape {region.shape}, the costmap {costmap.costs.shape}: it was made "
            "for another map"
        )
    return region


def _as_rows(values: ArrayLike, width: int, height: int) -> NDArray[np.integer]:
    array = np.asarray(values)
    if width < 1 or height < 1 or array.size != width * height:
        raise InvalidMap(
            f"a costmap of width {width} and height {height} needs width * height >= 1 values; "
            f"got {array.size}"
        )
    return array.reshape(height, width)


def _cost_at(state: Sequence[float], costmap: Costmap) -> int | None:
    """Cost of the cell of a state, None beside the map."""
    if not costmap.grid.contains(state[:2]):
        return None
    return int(costmap.costs[tuple(costmap.grid.to_rc(state[:2]))])


def _disc(grid: OccupancyGrid, centre: Sequence[float], radius: float) -> NDArray[np.bool_]:
    """(H, W) bool: the cells whose centre is at most `radius` [m] from a point."""
    x, y = grid.frame.to_local(np.asarray(centre[:2])) / grid.resolution - 0.5
    rows, columns = np.ogrid[: grid.shape[0], : grid.shape[1]]
    return np.asarray((columns - x) ** 2 + (rows - y) ** 2 <= (radius / grid.resolution) ** 2)


def _outside(name: str, state: Sequence[float], grid: OccupancyGrid) -> str:
    return f"the {name} ({state[0]:g}, {state[1]:g}) m is outside the map {grid!r}"


def _closed(
    name: str, state: Sequence[float], cost: int, nearest: tuple[float, float] | None
) -> str:
    place = "nothing on this map" if nearest is None else f"({nearest[0]:.3f}, {nearest[1]:.3f}) m"
    return (
        f"the {name} ({state[0]:g}, {state[1]:g}) m is in {_NAMES[cost]} space (cost {cost}); "
        f"the nearest passable point is {place}"
    )


def _published_table() -> NDArray[np.int8]:
    """(256,) values that a Nav2 costmap publishes for costs, nav2_costmap_2d's Costmap2DPublisher.

    Ordinary costs from 1 on are scaled to 1 to 98, rounded down.
    """
    costs = np.arange(256)
    table = np.where(costs == 0, 0, 1 + 97 * (costs - 1) // (DEAREST - 1))
    table[[INSCRIBED, LETHAL, UNKNOWN]] = 99, 100, -1
    return table.astype(np.int8)


_PUBLISHED = _published_table()
# Indexed by the published value: -1 is the last of 102.
_COSTS = np.append(np.searchsorted(_PUBLISHED[:UNKNOWN], range(101)), UNKNOWN).astype(np.uint8)
