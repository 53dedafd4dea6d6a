"""Show a network where a path starts and ends."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from planformer.encoding.scale import NetworkScale, QueryKind
from planformer.encoding.wavefront import detours
from planformer.encoding.window import Window, whole_map, windows_round
from planformer.errors import InvalidParameter

States = tuple[NDArray[np.float64], NDArray[np.float64]]
"""Start and goal."""

SQUARE_SIDE = 32
"""Side in pixels of the squares that mark start and goal in the paper's encoding."""

MARKER_SIGMA = 0.5
"""Standard deviation of the soft start and goal markers in metres."""

DISTANCE_SCALE = 10.0
"""Geodesic distances enter as tanh(distance / 10 m)."""

EXCESS_SCALE = 3.0
"""A detour of this many coarse cells more than the shortest dims a cell to 1/e."""

POINT_DETOURS, CAR_DETOURS = 1.5, 5.0
"""Cells further out of the way than this, in metres, tell a network nothing: it says the same of a
point robot's way with 1.5 m as with 5 m, where a car's errs a little more with 3 m."""

_DETOUR = 2
"""Which of the waves is the detour."""


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
    waves = _waves(pixels, states, scale)
    return _channels(pixels, states, scale, waves, whole_map(pixels.shape, scale))


def encode_windows(
    pixels: NDArray[np.uint8], start: ArrayLike, goal: ArrayLike, scale: NetworkScale
) -> list[tuple[Window, NDArray[np.float32]]]:
    """Encode start and goal for a network that sees only the parts of the map that matter.

    Where waves have told that every way is too long, nothing is left to predict; so the cost of a
    prediction grows with the query rather than with the map.

    Args:
        pixels: As for `encode_query`, as are the others and the errors.
        start: (x, y) or (x, y, yaw).
        goal: As `start`.
        scale: The network's scale.

    Returns:
        Windows to cut out of the map, each with its part of what `encode_query` gives. One window
        of the whole map for networks that are shown no waves, and where no way joins start and
        goal.
    """
    states = _state("start", start, scale), _state("goal", goal, scale)
    waves = _waves(pixels, states, scale)
    windows = [] if waves is None else windows_round(np.isfinite(waves[_DETOUR]), scale)
    return [
        (window, _channels(pixels, states, scale, waves, window))
        for window in windows or [whole_map(pixels.shape, scale)]
    ]


def _channels(
    pixels: NDArray[np.uint8],
    states: States,
    scale: NetworkScale,
    waves: NDArray[np.float32] | None,
    window: Window,
) -> NDArray[np.float32]:
    """(scale.query_channels, h, w) float32, the query in a window."""
    if scale.query is QueryKind.SQUARE:
        return _square_query(pixels.shape, states, scale)
    markers = np.stack([_marker(window, state, scale) for state in states])
    free = _free_share(window.cut(pixels, scale.stride), scale.query_stride)
    channels: list[NDArray[np.floating]] = [markers, free[None]]
    if waves is not None:
        part = window.cut(waves, scale.stride // scale.query_stride)
        channels.insert(1, _distance_channels(part, scale))
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
    shape: tuple[int, ...], states: States, scale: NetworkScale
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


def _marker(window: Window, state: NDArray[np.float64], scale: NetworkScale) -> NDArray[np.float64]:
    """(h, w) Gaussian of the distance to a point, as far as a query pixel can tell."""
    side = scale.stride // scale.query_stride
    bell_y, bell_x = (
        np.exp(-0.5 * ((_centres(part, side, scale) - at) / MARKER_SIGMA) ** 2)
        for part, at in zip((window.rows, window.cols), state[1::-1], strict=True)
    )
    return np.outer(bell_y, bell_x)


def _centres(tokens: slice, side: int, scale: NetworkScale) -> NDArray[np.float64]:
    """The middles, in metres, of the query pixels of some tokens along one axis."""
    return (np.arange(side * tokens.start, side * tokens.stop) + 0.5) * scale.query_resolution


def _free_share(pixels: NDArray[np.uint8], side: int) -> NDArray[np.float64]:
    """(h, w) share of free pixels in each square of `side` pixels."""
    height, width = pixels.shape
    # Rows first, as integers: many times as fast as a mean over both axes.
    rows = pixels.reshape(height // side, side, width).sum(axis=1, dtype=np.int32)
    blocked = rows.reshape(height // side, width // side, side).sum(axis=2)
    free: NDArray[np.float64] = 1.0 - blocked / side**2
    return free


def _distance_channels(waves: NDArray[np.float32], scale: NetworkScale) -> NDArray[np.floating]:
    """(3, h, w): how far from the start, how far from the goal, how small the detour."""
    reach = DISTANCE_SCALE / scale.query_resolution
    return np.concatenate(
        [np.tanh(waves[:_DETOUR] / reach), np.exp(-waves[_DETOUR:] / EXCESS_SCALE)]
    )


def _waves(
    pixels: NDArray[np.uint8], states: States, scale: NetworkScale
) -> NDArray[np.float32] | None:
    """(3, h, w) distance from start and goal and detour, in query pixels, of the whole map.

    They are those of the map's full resolution: cells as coarse as the query's would close narrow
    gaps or open thin walls, and the shortest way often leads through a narrow gap. Pixels too far
    out of the way look as if they were infinitely far, which saves much of the search. None for a
    network that is shown no waves.
    """
    if scale.query is not QueryKind.WAVEFRONT:
        return None
    side = scale.query_stride
    limit = CAR_DETOURS if scale.headings else POINT_DETOURS
    found = _detours(pixels > 0, states, scale.resolution, limit, side)
    if found is None:
        # Resampling has closed the way, or there is none: any free pixel opens a query pixel.
        coarse = _free_share(pixels, side) == 0.0
        found = _detours(coarse, states, scale.query_resolution, limit, 1)
    return np.full((3, *coarse.shape), np.inf, np.float32) if found is None else found


def _detours(
    blocked: NDArray[np.bool_],
    states: States,
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
