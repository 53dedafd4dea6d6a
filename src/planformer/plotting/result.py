"""The picture of a plan."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure

from planformer.maps import OccupancyGrid
from planformer.planning import PlanResult
from planformer.plotting.annotations import draw_annotations
from planformer.plotting.layers import draw_ends, draw_map, draw_path, draw_region, draw_tree
from planformer.plotting.layout import DPI, make_layout
from planformer.plotting.view import make_view
from planformer.robots import Robot


def plot_result(
    grid: OccupancyGrid,
    robot: Robot,
    start: Sequence[float],
    goal: Sequence[float],
    result: PlanResult,
    *,
    title: str | None = None,
) -> Figure:
    """Draw a plan: map, region proposal, search tree, path, start and goal.

    The axes are metres in the world frame; a turned map is drawn turned, unknown space round the
    observed part is cut off. The tree is drawn where the plan kept it (`keep_tree=True`). Nothing
    of Matplotlib's global state is used, so that pictures may be drawn in any thread and beside
    the caller's own figures.

    Args:
        grid: The map.
        robot: The robot.
        start: (x, y) or, for a car, (x, y, yaw) in the world frame, metres and rad.
        goal: As the start.
        result: What `planformer.plan` returned for them.
        title: Line above the picture.

    Returns:
        A Matplotlib figure; see `save_picture`.
    """
    ends = [np.asarray(state, np.float64) for state in (start, goal)]
    view = make_view(grid, [state[:2] for state in ends])
    layout = make_layout(view)
    longer = layout.figure.get_size_inches().max() * DPI
    draw_map(layout.axes, view, robot.radius, result.region, pixels=int(longer))
    if result.region is not None:
        draw_region(layout.axes, grid, result.region)
    if result.tree is not None:
        draw_tree(layout.axes, robot, result.tree)
    if result.solved:
        draw_path(layout.axes, robot, result.path)
    draw_ends(layout.axes, *ends)
    draw_annotations(layout, robot, result, title)
    return layout.figure
