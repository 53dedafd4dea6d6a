"""The edges of a search tree as lines: what a robot drives from one state to the next."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from planformer import _core
from planformer.robots import DubinsCar, Robot


def edge_lines(
    robot: Robot, vertices: NDArray[np.float64], edges: NDArray[np.int64]
) -> list[NDArray[np.float64]]:
    """Lines along the edges: straight for a point robot, along its shortest curves for a car.

    SST's edges are single arcs of any curvature, for which the shortest curves stand in.

    Args:
        robot: The robot.
        vertices: (V, 2) or (V, 3) states.
        edges: (E, 2) indices (parent, child) into them.

    Returns:
        (N, 2) points in metres of each edge, N >= 2: the states and, on arcs, what is between.
    """
    if not isinstance(robot, DubinsCar):
        return list(vertices[edges][..., :2])
    step = robot.turning_radius / 6.0
    poses = np.ascontiguousarray(vertices)
    return [
        _core.curve_poses(poses[parent], poses[child], robot.turning_radius, robot.reverses, step)[
            :, :2
        ]
        for parent, child in edges
    ]
