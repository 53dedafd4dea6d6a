"""The point robot: a disc that moves in any direction."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from planformer.robots.robot import Robot


@dataclass(frozen=True)
class PointRobot(Robot):
    """A disc that moves in any direction; its state is (x, y).

    Attributes:
        radius: Radius of the disc in metres. The default is the paper's.
    """

    state_dimension: ClassVar[int] = 2

    radius: float = 0.1

    def motion_errors(self, path: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Nothing is impossible for a robot that moves in any direction."""
        return np.zeros(max(len(path) - 1, 0), dtype=bool)
