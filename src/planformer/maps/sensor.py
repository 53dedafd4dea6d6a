"""What a laser scanner makes of a building: thin ragged surfaces, the unknown behind them."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

_FINEST_NOISE = 0.06
"""Surfaces are made ragged up to this resolution in metres; above it a cell is wider than noise."""
_SPECKLES_PER_SQUARE_METRE = 0.04


def observe(
    rng: np.random.Generator, free: NDArray[np.bool_], resolution: float
) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Map a building as a scanner does.

    Args:
        rng: Source of randomness.
        free: (H, W) bool, the true free space.
        resolution: Side of a cell in metres.

    Returns:
        Occupied and unknown cells, (H, W) bool each; unknown cells count as occupied. A surface
        is black where it was seen and a cell or two thick, everything behind it is unknown.
    """
    if resolution <= _FINEST_NOISE:
        free = _roughen(rng, free, resolution)
    free = _add_speckles(rng, free, resolution)
    surface = _dilate(free) & ~free
    jitter = rng.random(free.shape, dtype=np.float32)
    thick = _dilate(surface) & (_smooth_noise(rng, free.shape, resolution) + 0.3 * jitter > 0.55)
    missed = (_smooth_noise(rng, free.shape, resolution) > 0.85) & (jitter < 0.6)
    seen = (surface & ~missed) | thick
    return ~free, ~free & ~seen


def _roughen(
    rng: np.random.Generator, free: NDArray[np.bool_], resolution: float
) -> NDArray[np.bool_]:
    """Let surfaces bulge by a cell here and there and recede by one, more in some places."""
    roughness = _smooth_noise(rng, free.shape, resolution) ** 2
    chance = rng.random(free.shape, dtype=np.float32)
    bulge = free & _dilate(~free) & (chance < 0.4 * roughness)
    # Only what has solid cells behind it recedes, so no wall gets a hole.
    near = _dilate(free)
    recede = ~free & near & _dilate(~near) & (chance > 1.0 - 0.3 * roughness)
    result: NDArray[np.bool_] = (free & ~bulge) | recede
    return result


def _add_speckles(
    rng: np.random.Generator, free: NDArray[np.bool_], resolution: float
) -> NDArray[np.bool_]:
    """Single cells where something passed by."""
    chance = _SPECKLES_PER_SQUARE_METRE * resolution**2
    return free & ~(rng.random(free.shape) < chance)


def _dilate(mask: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """The mask and its eight neighbours; NumPy alone."""
    grown: NDArray[np.bool_] = mask.copy()
    grown[1:] |= mask[:-1]
    grown[:-1] |= mask[1:]
    rows = grown.copy()
    grown[:, 1:] |= rows[:, :-1]
    grown[:, :-1] |= rows[:, 1:]
    return grown


def _smooth_noise(
    rng: np.random.Generator, shape: tuple[int, ...], resolution: float
) -> NDArray[np.float32]:
    """(H, W) noise in [0, 1] that varies over about a metre: bilinear between random knots."""
    knots = rng.random([math.ceil(n * resolution) + 2 for n in shape], dtype=np.float32)
    for axis, n in enumerate(shape):
        at = np.arange(n) * resolution
        low = at.astype(np.intp)
        weight = (at - low).astype(np.float32).reshape((-1, 1) if axis == 0 else (1, -1))
        knots = knots.take(low, axis) * (1 - weight) + knots.take(low + 1, axis) * weight
    return knots
