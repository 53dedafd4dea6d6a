"""Show a network where a path starts and ends."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from planformer.encoding.scale import NetworkScale, QueryKind
from planformer.encoding.wavefront import detours
from planformer.errors import InvalidParameter

SQUARE_SIDE = 32
"""Side in pixels of the squares that mark start and goal in the paper's encoding."""

MARKER_SIGMA = 0.5
"""Standard deviation of the soft start and goal markers in metres."""

DISTANCE_SCALE = 10.0
"""Geodesic distances enter as tanh(distance / 10 m)."""

EXCESS_SCALE = 3.0
"""A detour of this many coarse cells more than the shortest dims a cell to 1/e."""

POINT_DETOURS, CAR_DETOURS = 2.0, 5.0
"""Cells further out of the way than this, in metres, tell a network nothing: it says the same of a
point robot's way with 2 m as with 5 m, where a car's errs a little more with 3 m."""


def encode_query(
    pixels: NDArray[np.uint8], start: ArrayLike, goal: ArrayLike, scale: NetworkScale
) -> NDArray[np.float32]:
    """Encode start and goal for a network.

    Args:
        pixels: (H, W) uint8 network map as `network_map` returns it.
        start: (x, y) or (x, y, yaw) in metres and rad in the map's local frame.
        goal: As `start`.
        scale: The network's scale.

    Returns:
        (scale.query_channels, H / query_stride, W / query_stride) float32.

    Raises:
        InvalidParameter: A state lacks the yaw that the network needs or is no state at all.
    """
    states = _state("start", start, scale), _state("goal", goal, scale)
    if scale.query is QueryKind.SQUARE:
        return _square_query(pixels.shape, states, scale)
    markers = np.stack([_marker(pixels.shape, state, scale) for state in states])
    free = _free_share(pixels, scale.query_stride)
    channels: list[NDArray[np.floating]] = [markers, free[None]]
    if scale.query is QueryKind.WAVEFRONT:
        channels.insert(1, _distance_channels(pixels, states, scale))
    if scale.headings:
        channels.append(
            np.concatenate(
                [_direction(s)[:, None, None] * m for s, m in zip(states, markers, strict=True)]
            )
        )
    return np.concatenate(channels).astype(np.float32)


def _state(name: str, value: ArrayLike, scale: NetworkScale) -> NDArray[np.float64]:
    state = np.asarray(value, dtype=np.float64)
    if state.shape not in ((2,), (3,)) or not np.isfinite(state).all():
        raise InvalidParameter(f"{name} must be finite (x, y) or (x, y, yaw); got {value!r}")
    if scale.headings and len(state) < 3:
        raise InvalidParameter(f"this network needs a {name} with yaw; got {value!r}")
    return state


def _direction(state: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.array([np.cos(state[2]), np.sin(state[2])])


def _square_query(
    shape: tuple[int, ...], states: tuple[NDArray[np.float64], ...], scale: NetworkScale
) -> NDArray[np.float32]:
    """The paper's encoding, section III.A: patches of -1 at the start and +1 at the goal."""
    query = np.zeros((scale.query_channels, *shape), np.float32)
    for state, sign in zip(states, (-1.0, 1.0), strict=True):  # where they overlap the goal wins
        rows, cols = (_patch(coordinate, scale) for coordinate in state[1::-1])
        query[0, rows, cols] = sign
        if scale.headings:
            query[1:, rows, cols] = _direction(state)[:, None, None]
    return query


def _patch(coordinate: float, scale: NetworkScale) -> slice:
    """The pixels of a square around a coordinate in metres, along one axis."""
    first = round(coordinate / scale.resolution) - SQUARE_SIDE // 2
    return slice(max(first, 0), max(first + SQUARE_SIDE, 0))


def _marker(
    shape: tuple[int, ...], state: NDArray[np.float64], scale: NetworkScale
) -> NDArray[np.float64]:
    """(h, w) Gaussian of the distance to a point, as far as a query pixel can tell."""
    y, x = (
        (np.arange(size // scale.query_stride) + 0.5) * scale.query_resolution for size in shape
    )
    bell_x, bell_y = (
        np.exp(-0.5 * ((axis - at) / MARKER_SIGMA) ** 2)
        for axis, at in ((x, state[0]), (y, state[1]))
    )
    return np.outer(bell_y, bell_x)


def _free_share(pixels: NDArray[np.uint8], side: int) -> NDArray[np.float64]:
    """(h, w) share of free pixels in each square of `side` pixels."""
    height, width = pixels.shape
    # Rows first, as integers: many times as fast as a mean over both axes.
    rows = pixels.reshape(height // side, side, width).sum(axis=1, dtype=np.int32)
    blocked = rows.reshape(height // side, width // side, side).sum(axis=2)
    free: NDArray[np.float64] = 1.0 - blocked / side**2
    return free


def _distance_channels(
    pixels: NDArray[np.uint8], states: tuple[NDArray[np.float64], ...], scale: NetworkScale
) -> NDArray[np.float32]:
    """(3, h, w): how far from the start, how far from the goal, how small the detour.

    The distances are those of the map's full resolution: cells as coarse as the query's would close
    narrow gaps or open thin walls, and the shortest way often leads through a narrow gap. Pixels
    too far out of the way look as if they were infinitely far, which saves much of the search.
    """
    side = scale.query_stride
    limit = CAR_DETOURS if scale.headings else POINT_DETOURS
    found = _detours(pixels > 0, states, scale.resolution, limit, side)
    if found is None:
        # Resampling has closed the way, or there is none: any free pixel opens a query pixel.
        coarse = _free_share(pixels, side) == 0.0
        found = _detours(coarse, states, scale.query_resolution, limit, 1)
    if found is None:
        found = np.full((3, *coarse.shape), np.inf, np.float32)
    reach = DISTANCE_SCALE / scale.query_resolution
    return np.concatenate([np.tanh(found[:2] / reach), np.exp(-found[2:] / EXCESS_SCALE)])


def _detours(
    blocked: NDArray[np.bool_],
    states: tuple[NDArray[np.float64], ...],
    resolution: float,
    limit: float,
    side: int,
) -> NDArray[np.float32] | None:
    """`detours` in query pixels, for squares of one query pixel."""
    start, goal = (_cell(state, blocked.shape, resolution) for state in states)
    found = detours(blocked, start, goal, limit / resolution, side)
    return None if found is None else found / np.float32(side)


def _cell(state: NDArray[np.float64], shape: tuple[int, ...], resolution: float) -> tuple[int, int]:
    """(row, col) of the cell of a state, the nearest one for a state outside."""
    row, col = (
        int(np.clip(np.floor(v / resolution), 0, size - 1))
        for v, size in zip(state[1::-1], shape, strict=True)
    )
    return row, col
