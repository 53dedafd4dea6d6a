"""Cars with a smallest turning radius, forward only (Dubins) or both ways (Reeds-Shepp)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from planformer.geometry import wrap_angle
from planformer.robots.robot import Robot, turn_and_chord

_SHORTEST_CHORD = 1e-6
"""Below this length [m] a chord's direction is rounding noise."""
_ANGLE_TOLERANCE = 1e-5
_CURVATURE_TOLERANCE = 1e-4


@dataclass(frozen=True)
class DubinsCar(Robot):
    """A car that drives forward and turns no tighter than a circle; its state is (x, y, yaw).

    Attributes:
        radius: Radius of the disc that covers the car in metres.
        turning_radius: Radius of the tightest circle in metres. The paper's car (wheelbase 0.3 m,
            steering up to 0.5 rad) has 0.549 m.
        wheelbase: Distance between the axles in metres. With the turning radius it gives the
            steering limit; only control-space planning (SST) uses it.
        max_speed: Highest speed in m/s; only control-space planning (SST) uses it.
    """

    state_dimension: ClassVar[int] = 3
    reverses: ClassVar[bool] = False

    radius: float = 0.2
    turning_radius: float = 0.55
    wheelbase: float = 0.3
    max_speed: float = 1.0

    @property
    def max_steering(self) -> float:
        """Largest steering angle in rad of the bicycle model."""
        return math.atan(self.wheelbase / self.turning_radius)

    def motion_errors(self, path: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Motions that are not one arc or straight line within the turning radius.

        The chord of an arc points along the mean of the headings at its ends.
        """
        turn, chord, direction = turn_and_chord(path)
        off_heading = np.abs(wrap_angle(direction - (path[:-1, 2] + 0.5 * turn)))
        if self.reverses:
            off_heading = np.minimum(off_heading, math.pi - off_heading)
        # sin(turn / 2) = chord / (2 radius) on an arc.
        tightest = chord / (2.0 * self.turning_radius) * (1.0 + _CURVATURE_TOLERANCE)
        too_tight = np.abs(np.sin(0.5 * turn)) > tightest + _ANGLE_TOLERANCE
        moved = chord > _SHORTEST_CHORD
        # What a chord's direction can tell shrinks with its length.
        skids = off_heading > _ANGLE_TOLERANCE * (1.0 + 0.01 / np.maximum(chord, _SHORTEST_CHORD))
        return np.asarray(too_tight | (moved & skids))


@dataclass(frozen=True)
class ReedsSheppCar(DubinsCar):
    """A car that also drives backwards; otherwise as `DubinsCar`."""

    reverses: ClassVar[bool] = True
