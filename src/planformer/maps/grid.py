"""The occupancy grid: an immutable map with a pose in the world and exact clearance."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from planformer.errors import InvalidMap, InvalidParameter
from planformer.geometry import Frame
from planformer.maps._validation import as_mask, as_xy, checked_origin, checked_resolution
from planformer.maps.resample import resample_masks

OCCUPIED_FROM = 65
"""nav_msgs/OccupancyGrid values from here to 100 are occupied (Nav2's and map_saver's default)."""
FREE_TO = 25
"""nav_msgs/OccupancyGrid values from 0 to here are free; between the two is unknown."""

_RADIUS_TOLERANCE = 1e-6
_FARTHEST_CELL = 2.0**62


@dataclass(frozen=True, eq=False)
class _Inflation:
    """A map inflated by a radius in metres, with what follows from that."""

    radius: float
    blocked: NDArray[np.bool_]

    @cached_property
    def components(self) -> NDArray[np.int32]:
        """See `OccupancyGrid.components`."""
        import cv2

        free = (~self.blocked).view(np.uint8)
        labels = cv2.connectedComponents(free, connectivity=4, ltype=cv2.CV_32S)[1]
        components = np.asarray(labels, dtype=np.int32)
        components.setflags(write=False)
        return components


@dataclass(frozen=True, init=False, repr=False, eq=False)
class OccupancyGrid:
    """An immutable occupancy map.

    Row 0 is the lowest y, column 0 the lowest x of the map's own frame; cell (r, c) covers
    [c, c + 1) x [r, r + 1) times the resolution. Everything outside counts as occupied.

    Attributes:
        occupied: (H, W) bool, read-only and C-contiguous.
        resolution: Side of a cell in metres.
        origin: World pose (x, y, yaw) of the lower-left corner of cell (0, 0), as in ROS.
        unknown: (H, W) bool, read-only: cells never observed. Whether such a cell can be
            entered is decided by `occupied` alone.

    Args:
        occupied: (H, W) array of bool or of 0 and 1.
        resolution: Side of a cell in metres, 1e-6 to 1e6.
        origin: (x, y) or (x, y, yaw) in metres and rad.
        unknown: Optional (H, W) mask of cells never observed; none by default.

    Raises:
        InvalidMap: An array, the resolution or the origin breaks these rules.
    """

    occupied: NDArray[np.bool_]
    resolution: float
    origin: tuple[float, float, float]
    unknown: NDArray[np.bool_]

    def __init__(
        self,
        occupied: ArrayLike,
        resolution: float = 0.05,
        origin: Sequence[float] = (0.0, 0.0),
        unknown: ArrayLike | None = None,
    ) -> None:
        cells = as_mask(occupied, "occupied")
        unseen = np.zeros(cells.shape, bool) if unknown is None else as_mask(unknown, "unknown")
        if unseen.shape != cells.shape:
            raise InvalidMap(
                f"unknown must have the shape of occupied, {cells.shape}; got {unseen.shape}"
            )
        for array in (cells, unseen):
            array.setflags(write=False)
        object.__setattr__(self, "occupied", cells)
        object.__setattr__(self, "resolution", checked_resolution(resolution))
        object.__setattr__(self, "origin", checked_origin(origin))
        object.__setattr__(self, "unknown", unseen)
        object.__setattr__(self, "_last_inflation", None)

    @classmethod
    def from_ros(
        cls,
        data: ArrayLike,
        width: int,
        height: int,
        resolution: float,
        origin: Sequence[float] = (0.0, 0.0),
        *,
        unknown_is_occupied: bool = True,
    ) -> OccupancyGrid:
        """Make a grid from the fields of a nav_msgs/OccupancyGrid message.

        Args:
            data: width * height integers, row-major from the lowest y: -1 unknown, 0 to 25 free,
                65 to 100 occupied; 26 to 64 count as unknown.
            width: Number of columns.
            height: Number of rows.
            resolution: Side of a cell in metres.
            origin: (x, y) or (x, y, yaw) of the lower-left corner.
            unknown_is_occupied: Whether unknown cells are obstacles.

        Raises:
            InvalidMap: The number of values or a value is wrong.
        """
        values = np.asarray(data)
        if width < 1 or height < 1 or values.size != width * height:
            raise InvalidMap(
                f"a ROS map of width {width} and height {height} needs width * height >= 1 values; "
                f"got {values.size}"
            )
        if values.dtype.kind not in "iuf" or not np.all((values >= -1) & (values <= 100)):
            raise InvalidMap("the values of a ROS map must be -1 or 0 to 100")
        values = values.reshape(height, width)
        occupied = values >= OCCUPIED_FROM
        unknown = ~occupied & ((values < 0) | (values > FREE_TO))
        return cls(occupied | (unknown & unknown_is_occupied), resolution, origin, unknown)

    def to_ros(self) -> NDArray[np.int8]:
        """(H * W,) int8 values of a nav_msgs/OccupancyGrid: -1 unknown, 0 free, 100 occupied."""
        values = np.where(self.occupied, 100, 0).astype(np.int8)
        values[self.unknown] = -1
        return values.ravel()

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns, (H, W)."""
        rows, columns = self.occupied.shape
        return rows, columns

    @property
    def width(self) -> float:
        """Extent along the map's own x axis in metres."""
        return self.shape[1] * self.resolution

    @property
    def height(self) -> float:
        """Extent along the map's own y axis in metres."""
        return self.shape[0] * self.resolution

    @cached_property
    def frame(self) -> Frame:
        """The map's own frame: its origin is the lower-left corner of cell (0, 0)."""
        return Frame(*self.origin)

    @property
    def free(self) -> NDArray[np.bool_]:
        """(H, W) bool, the complement of `occupied`."""
        return ~self.occupied

    def contains(self, xy: ArrayLike) -> NDArray[np.bool_]:
        """Whether world points (..., 2) in metres lie on the map; NaN and infinity do not."""
        rows, columns = self.shape
        points = as_xy(xy)
        with np.errstate(invalid="ignore", over="ignore"):
            cells = self.frame.to_local(points) / self.resolution
        x, y = cells[..., 0], cells[..., 1]
        return np.asarray((x >= 0) & (x < columns) & (y >= 0) & (y < rows))

    def to_rc(self, xy: ArrayLike) -> NDArray[np.int64]:
        """Cells (row, column) of world points, also of points beside the map.

        Args:
            xy: (..., 2) points in metres.

        Returns:
            (..., 2) int64; indices beside the map are not clipped to it.

        Raises:
            InvalidParameter: A coordinate is not finite.
        """
        points = as_xy(xy)
        if not np.isfinite(points).all():
            raise InvalidParameter("coordinates must be finite to be turned into cells")
        with np.errstate(over="ignore"):
            cells = np.floor(self.frame.to_local(points) / self.resolution)[..., ::-1]
        # Far beyond any map; only keeps the conversion to integers defined.
        return np.clip(cells, -_FARTHEST_CELL, _FARTHEST_CELL).astype(np.int64)

    def to_xy(self, rc: ArrayLike) -> NDArray[np.float64]:
        """World coordinates (..., 2) in metres of the centres of cells (..., 2)."""
        cells = np.asarray(rc, dtype=np.float64)
        return self.frame.to_world((cells[..., ::-1] + 0.5) * self.resolution)

    @cached_property
    def clearance(self) -> NDArray[np.float32]:
        """Exact distance to the nearest obstacle.

        (H, W) float32, metres, read-only: the Euclidean distance from each cell's centre to the
        nearest occupied cell's centre, where the ring of cells just outside the map is occupied.
        Felzenszwalb and Huttenlocher, Distance Transforms of Sampled Functions, 2012.
        """
        import cv2

        free = np.pad(self.free.view(np.uint8), 1)
        cells = cv2.distanceTransform(free, cv2.DIST_L2, cv2.DIST_MASK_PRECISE)[1:-1, 1:-1]
        clearance: NDArray[np.float32] = np.multiply(cells, self.resolution, dtype=np.float32)
        clearance = np.ascontiguousarray(clearance)
        clearance.setflags(write=False)
        return clearance

    def blocked(self, radius: float) -> NDArray[np.bool_]:
        """Cells whose centre a disc robot cannot occupy.

        A cell is blocked when its clearance is at most the radius (as Nav2's inscribed inflation);
        a relative tolerance of 1e-6 lets 0.1 m be exactly two cells of 0.05 m.

        Args:
            radius: Radius of the robot in metres; 0 blocks the occupied cells alone.

        Returns:
            (H, W) bool, read-only; kept for the last radius asked for.

        Raises:
            InvalidParameter: The radius is negative or not finite.
        """
        return self._inflation(radius).blocked

    def components(self, radius: float) -> NDArray[np.int32]:
        """Parts of the map that a disc robot cannot leave.

        Four neighbours are exact: a motion through a corner touches the cells beside it.

        Args:
            radius: As in `blocked`.

        Returns:
            (H, W) int32, read-only: the number of each free cell's 4-connected component, 0 where
            blocked; kept for the last radius asked for.

        Raises:
            InvalidParameter: The radius is negative or not finite.
        """
        return self._inflation(radius).components

    def _inflation(self, radius: float) -> _Inflation:
        if not (math.isfinite(radius) and radius >= 0):
            raise InvalidParameter(f"radius must be finite and >= 0 m; got {radius}")
        last: _Inflation | None = self.__dict__["_last_inflation"]
        if last is None or last.radius != radius:
            blocked = self.clearance <= np.float32(radius * (1.0 + _RADIUS_TOLERANCE))
            blocked.setflags(write=False)
            last = _Inflation(radius, blocked)
            object.__setattr__(self, "_last_inflation", last)
        return last

    def nearest_free(self, xy: ArrayLike, radius: float = 0.0) -> tuple[float, float] | None:
        """Centre of the non-blocked cell nearest to a world point.

        Args:
            xy: Point (x, y) in metres, on the map or beside it.
            radius: Radius of the robot in metres.

        Returns:
            World point (x, y), or None where every cell is blocked.

        Raises:
            InvalidParameter: A coordinate is not finite, or the radius is negative.
        """
        target = self.frame.to_local(as_xy(xy)) / self.resolution
        row, column = (int(i) for i in self.to_rc(xy))
        free, reach = ~self.blocked(radius), 16
        while True:  # a window twice as large each time: the answer is usually close
            r0, c0 = max(row - reach, 0), max(column - reach, 0)
            window = free[r0 : max(row + reach + 1, 0), c0 : max(column + reach + 1, 0)]
            cells = np.argwhere(window) + np.array((r0, c0))
            if len(cells):
                distance = np.hypot(*(cells[:, ::-1] + 0.5 - target).T)
                best = int(distance.argmin())
                if distance[best] <= reach or window.shape == free.shape:
                    x, y = self.to_xy(cells[best])
                    return float(x), float(y)
            elif window.shape == free.shape:
                return None
            reach *= 2

    def resampled(self, resolution: float) -> OccupancyGrid:
        """The same map at another resolution, with the same origin.

        A coarser cell is occupied if any finer cell that overlaps it is, or if it reaches beyond
        the map, where everything is occupied: what is free afterwards was free before. A finer cell
        takes the value of the cell nearest to its centre.

        Args:
            resolution: Side of the new cells in metres.

        Returns:
            The new map; it covers the old one and less than one new cell more on the far sides.

        Raises:
            InvalidMap: The resolution is not between 1e-6 and 1e6 m.
        """
        ratio = checked_resolution(resolution) / self.resolution
        if ratio == 1.0:
            return self
        occupied, unknown = resample_masks(self.occupied, self.unknown, ratio)
        return OccupancyGrid(occupied, resolution, self.origin, unknown)

    def __reduce__(self) -> tuple[type[OccupancyGrid], tuple[object, ...]]:
        # Through the constructor: a copy in another process is read-only too, and without caches.
        return OccupancyGrid, (self.occupied, self.resolution, self.origin, self.unknown)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, OccupancyGrid):
            return NotImplemented
        return (
            self.resolution == other.resolution
            and self.origin == other.origin
            and np.array_equal(self.occupied, other.occupied)
            and np.array_equal(self.unknown, other.unknown)
        )

    def __hash__(self) -> int:
        return hash((self.shape, self.resolution, self.origin))

    def _repr_html_(self) -> str:
        from planformer.notebook import map_html

        return map_html(self)

    def __repr__(self) -> str:
        rows, columns = self.shape
        x, y, yaw = self.origin
        return (
            f"OccupancyGrid({columns} x {rows} cells, {self.width:g} x {self.height:g} m, "
            f"resolution={self.resolution:g}, origin=({x:g}, {y:g}, {yaw:g}), "
            f"occupied={self.occupied.mean():.1%}, unknown={self.unknown.mean():.1%})"
        )
