"""Plane geometry shared by all layers: angles, polylines and rigid frames. NumPy only."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from planformer.errors import InvalidParameter

_PAIRS_AT_ONCE = 2**16
"""Points times segments that a distance is computed for in one piece of memory."""
_TWO_PI = 2.0 * math.pi


@overload
def wrap_angle(angle: float) -> float: ...
@overload
def wrap_angle(angle: NDArray[np.floating]) -> NDArray[np.float64]: ...
def wrap_angle(angle: float | NDArray[np.floating]) -> float | NDArray[np.float64]:
    """Wrap angles to (-pi, pi].

    Args:
        angle: Angle or array of angles in rad. Angles already inside are returned unchanged.

    Returns:
        The equivalent angle; a float for a scalar, an array of the same shape otherwise.
    """
    a = np.asarray(angle, dtype=np.float64)
    wrapped = math.pi - np.mod(math.pi - a, _TWO_PI)
    wrapped = np.where(wrapped <= -math.pi, math.pi, wrapped)  # mod may round up to 2 pi
    result = np.where((a > -math.pi) & (a <= math.pi), a, wrapped)
    return result if np.ndim(angle) else float(result)


def polyline_length(points: ArrayLike) -> float:
    """Length of a polyline in the plane.

    Args:
        points: (N, 2) points or (N, 3) poses in metres; yaw does not count.

    Returns:
        The sum of the segment lengths in metres, 0.0 for fewer than two points.
    """
    steps = np.diff(np.asarray(points, dtype=np.float64)[:, :2], axis=0)
    return float(np.hypot(steps[:, 0], steps[:, 1]).sum())


def distance_to_polyline(points: ArrayLike, polyline: ArrayLike) -> NDArray[np.float64]:
    """Distance from points to the nearest point of a polyline.

    Args:
        points: (M, 2) query points in metres.
        polyline: (N, 2) vertices in metres, N >= 1; a single vertex is a point.

    Returns:
        (M,) distances in metres.

    Raises:
        InvalidParameter: The polyline has no vertex.
    """
    offset = offset_to_polyline(points, polyline)
    return np.asarray(np.hypot(offset[:, 0], offset[:, 1]))


def offset_to_polyline(points: ArrayLike, polyline: ArrayLike) -> NDArray[np.float64]:
    """Way from points to the nearest point of a polyline.

    Args:
        points: (M, 2) query points in metres.
        polyline: (N, 2) vertices in metres, N >= 1; a single vertex is a point.

    Returns:
        (M, 2) vectors in metres.

    Raises:
        InvalidParameter: The polyline has no vertex.
    """
    queries = np.asarray(points, dtype=np.float64).reshape(-1, 2)
    vertices = np.asarray(polyline, dtype=np.float64).reshape(-1, 2)
    if len(vertices) == 0:
        raise InvalidParameter("a polyline needs at least one vertex; got none")
    best: NDArray[np.float64] = vertices[0] - queries
    squared = (best**2).sum(axis=1)
    # Some segments at a time: paths of a car have many, maps have many points.
    piece = max(1, _PAIRS_AT_ONCE // max(len(queries), 1))
    for first in range(0, len(vertices) - 1, piece):
        x, y = _offsets_to_segments(queries, vertices[first : first + piece + 1])
        distances = x * x + y * y
        nearest = np.arange(len(queries)), distances.argmin(axis=1)
        nearer = distances[nearest] < squared
        offsets = np.column_stack((x[nearest], y[nearest]))
        best = np.where(nearer[:, None], offsets, best)
        squared = np.minimum(squared, distances[nearest])
    return best


def _offsets_to_segments(
    points: NDArray[np.float64], vertices: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Vectors from (M, 2) points to the nearest points of N - 1 segments: x and y, (M, N - 1)."""
    dx, dy = np.diff(vertices, axis=0).T
    squared_length = dx * dx + dy * dy
    from_x, from_y = (points[:, None, axis] - vertices[:-1, axis] for axis in (0, 1))
    along = (from_x * dx + from_y * dy) / np.where(squared_length > 0.0, squared_length, 1.0)
    np.clip(along, 0.0, 1.0, out=along)
    return along * dx - from_x, along * dy - from_y


@dataclass(frozen=True)
class Frame:
    """A rigid frame in the plane, given by its pose in the world (REP 103 conventions).

    Attributes:
        x: Position of the frame's origin in the world in metres.
        y: Position of the frame's origin in the world in metres.
        yaw: Counter-clockwise rotation of the frame in rad.

    Raises:
        InvalidParameter: A value is not finite.
    """

    x: float = 0.0
    y: float = 0.0
    yaw: float = 0.0

    def __post_init__(self) -> None:
        for name in ("x", "y", "yaw"):
            value = float(getattr(self, name))
            if not math.isfinite(value):
                raise InvalidParameter(f"a frame's {name} must be finite; got {value}")
            object.__setattr__(self, name, value)

    def to_local(self, points: ArrayLike) -> NDArray[np.float64]:
        """Express world points or poses in this frame.

        Args:
            points: (..., 2) points or (..., 3) poses (x, y, yaw) in metres and rad.

        Returns:
            A new float64 array of the same shape; yaw wrapped to (-pi, pi].

        Raises:
            InvalidParameter: The last axis is neither 2 nor 3 long.
        """
        p = _as_points(points)
        dx, dy = p[..., 0] - self.x, p[..., 1] - self.y
        c, s = math.cos(self.yaw), math.sin(self.yaw)
        return _assemble(p, c * dx + s * dy, c * dy - s * dx, -self.yaw)

    def to_world(self, points: ArrayLike) -> NDArray[np.float64]:
        """Express points or poses of this frame in the world; the inverse of `to_local`."""
        p = _as_points(points)
        x, y = p[..., 0], p[..., 1]
        c, s = math.cos(self.yaw), math.sin(self.yaw)
        return _assemble(p, self.x + c * x - s * y, self.y + s * x + c * y, self.yaw)


def _as_points(points: ArrayLike) -> NDArray[np.float64]:
    p = np.asarray(points, dtype=np.float64)
    if p.ndim == 0 or p.shape[-1] not in (2, 3):
        raise InvalidParameter(f"points must have shape (..., 2) or (..., 3); got {p.shape}")
    return p


def _assemble(
    source: NDArray[np.float64], x: NDArray[np.float64], y: NDArray[np.float64], turn: float
) -> NDArray[np.float64]:
    """Stack x, y and, for poses, the yaw of `source` turned by `turn`."""
    result = np.empty_like(source)
    result[..., 0], result[..., 1] = x, y
    if source.shape[-1] == 3:
        result[..., 2] = wrap_angle(source[..., 2] + turn)
    return result
