"""Plane geometry shared by all layers: angles, polylines and rigid frames. NumPy only."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from typing import overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from planformer.errors import InvalidParameter

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
    return _length(offset_to_polyline(points, polyline))


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
    best = _offset_to_segment(queries, vertices[0], vertices[0])
    distance = _length(best)
    # One pass a segment keeps memory at O(M); paths have few segments, maps have many points.
    for a, b in itertools.pairwise(vertices):
        offset = _offset_to_segment(queries, a, b)
        nearer = _length(offset) < distance
        best[nearer] = offset[nearer]
        distance[nearer] = _length(offset[nearer])
    return best


def _length(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    """(M,) lengths of (M, 2) vectors."""
    return np.asarray(np.hypot(vectors[:, 0], vectors[:, 1]))


def _offset_to_segment(
    points: NDArray[np.float64], a: NDArray[np.float64], b: NDArray[np.float64]
) -> NDArray[np.float64]:
    """(M, 2) vectors from (M, 2) points to the nearest points of the segment from a to b."""
    direction = b - a
    squared_length = float(direction @ direction)
    if squared_length == 0.0:
        along = np.zeros(len(points))
    else:
        along = np.clip((points - a) @ direction / squared_length, 0.0, 1.0)
    return np.asarray(a + along[:, None] * direction - points)


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
