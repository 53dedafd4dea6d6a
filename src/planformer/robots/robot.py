"""What all robots have in common: a disc that moves in the plane."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from planformer.errors import InvalidRobot
from planformer.geometry import wrap_angle


@dataclass(frozen=True)
class Robot:
    """A disc-shaped robot; use one of its subclasses.

    Attributes:
        radius: Radius of the disc in metres; 0 is a true point.

    Raises:
        InvalidRobot: A dimension is not finite or out of range.
    """

    state_dimension: ClassVar[int]
    """2 for states (x, y), 3 for states (x, y, yaw)."""

    radius: float

    def __post_init__(self) -> None:
        for field in fields(self):
            value = float(getattr(self, field.name))
            lowest_allowed = field.name == "radius" and value == 0.0
            if not (math.isfinite(value) and (value > 0.0 or lowest_allowed)):
                bound = ">= 0" if field.name == "radius" else "> 0"
                raise InvalidRobot(f"{field.name} must be finite and {bound}; got {value}")
            object.__setattr__(self, field.name, value)

    def motion_errors(self, path: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Which motions between consecutive states the robot cannot make, obstacles aside.

        Args:
            path: (N, state_dimension) states in metres and rad.

        Returns:
            (N - 1,) bool, True for an impossible motion.
        """
        raise NotImplementedError


def turn_and_chord(
    path: NDArray[np.float64],
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Yaw change, chord length and the chord's direction of each motion of (N, 3) poses."""
    steps = np.diff(path[:, :2], axis=0)
    turn = wrap_angle(np.diff(path[:, 2]))
    return turn, np.hypot(steps[:, 0], steps[:, 1]), np.arctan2(steps[:, 1], steps[:, 0])
