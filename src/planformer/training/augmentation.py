"""More problems from the same paths: mirror, turn and reverse them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

_Transform: TypeAlias = Callable[[NDArray[np.float64]], NDArray[np.float64]]


@dataclass(frozen=True, eq=False)
class Example:
    """A map with a solved problem, in the map's local frame.

    Attributes:
        blocked: (H, W) bool, where the robot's centre must not be.
        resolution: Side of a cell in metres.
        start: (2,) or (3,) state in metres and rad.
        goal: As `start`.
        path: (N, 2) or (N, 3) from start to goal.
    """

    blocked: NDArray[np.bool_]
    resolution: float
    start: NDArray[np.float64]
    goal: NDArray[np.float64]
    path: NDArray[np.float64]


def augment(example: Example, rng: np.random.Generator) -> Example:
    """One of the eight symmetries of the square and one of two directions, at random."""
    *symmetry, reverse = rng.integers(2, size=4, dtype=bool)
    example = turned(example, *symmetry)
    return reversed_example(example) if reverse else example


def turned(example: Example, transpose: bool, mirror_x: bool, mirror_y: bool) -> Example:
    """One of the eight symmetries of the square: x and y exchanged first, then mirrored."""
    if transpose:
        example = transposed(example)
    if mirror_x:
        example = mirrored(example)
    if mirror_y:
        example = transposed(mirrored(transposed(example)))
    return example


def mirrored(example: Example) -> Example:
    """The example seen in a mirror: x becomes the map's width - x."""
    width = example.blocked.shape[1] * example.resolution

    def mirror(states: NDArray[np.float64]) -> NDArray[np.float64]:
        result: NDArray[np.float64] = states.copy()
        result[..., 0] = width - states[..., 0]
        result[..., 2:] = np.pi - states[..., 2:]
        return result

    return _mapped(example, example.blocked[:, ::-1], mirror)


def transposed(example: Example) -> Example:
    """The example with x and y exchanged."""

    def exchange(states: NDArray[np.float64]) -> NDArray[np.float64]:
        result: NDArray[np.float64] = states.copy()
        result[..., :2] = states[..., 1::-1]
        result[..., 2:] = np.pi / 2 - states[..., 2:]
        return result

    return _mapped(example, example.blocked.T, exchange)


def reversed_example(example: Example) -> Example:
    """The example driven the other way round; a car turns about, its curves remain the same."""
    start, goal, path = example.goal.copy(), example.start.copy(), example.path[::-1].copy()
    for states in (start, goal, path):
        states[..., 2:] += np.pi
    return Example(example.blocked, example.resolution, start, goal, path)


def _mapped(example: Example, blocked: NDArray[np.bool_], transform: _Transform) -> Example:
    states = (transform(s) for s in (example.start, example.goal, example.path))
    return Example(blocked, example.resolution, *states)
