"""The best path known of a problem, against which all others are measured."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from planformer.bench.guides import PathProposer
from planformer.data.experts import create_expert, expert_names
from planformer.geometry import polyline_length
from planformer.planning import Problem, SearchLimits, search

_CAR_SECONDS = 2.0
"""Limit of the search for a better path than the expert's."""


def reference_path(problem: Problem, seed: int) -> NDArray[np.float64] | None:
    """Find a path that is as short as possible.

    Args:
        problem: The problem.
        seed: Seed of the search for a car.

    Returns:
        (N, 2) or (N, 3) path in the world frame, None if none was found. For a point robot the
        any-angle shortest path. For a car that of Hybrid-A*, or the one that RRT* then finds along
        it within two seconds, if that is shorter.
    """
    robot = problem.robot
    path = create_expert(expert_names(robot)[0], robot).solve(problem, seed)
    if path is None or robot.state_dimension == 2:
        return path
    region = PathProposer(path).propose(problem).sampling()
    limits = SearchLimits(seconds=_CAR_SECONDS)
    found = search(problem, "RRTstar", region=region, limits=limits, seed=seed)
    return found.path if found.length < polyline_length(path) else path
