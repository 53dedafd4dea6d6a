"""The picture of a plan."""

from __future__ import annotations

from matplotlib.figure import Figure

from planformer.planning import PlanResult
from planformer.plotting.annotations import draw_annotations
from planformer.plotting.layers import draw_ends, draw_map, draw_result
from planformer.plotting.layout import DPI, make_layout
from planformer.plotting.view import make_view


def plot_result(result: PlanResult, *, title: str | None = None) -> Figure:
    """Draw a plan: map, region proposal, search tree, path, start and goal.

    The axes are metres in the world frame; a turned map is drawn turned, unknown space round the
    observed part is cut off. The tree is drawn where the plan kept it (`keep_tree=True`). Nothing
    of Matplotlib's global state is used, so that pictures may be drawn in any thread and beside
    the caller's own figures.

    Args:
        result: What `planformer.plan` returned.
        title: Line above the picture.

    Returns:
        A Matplotlib figure, which notebooks show; see `save_picture`.
    """
    view = make_view(result.problem.grid, [result.problem.start[:2], result.problem.goal[:2]])
    layout = make_layout(view)
    longer = layout.figure.get_size_inches().max() * DPI
    draw_map(layout.axes, view, result.problem.robot.radius, result.region, pixels=int(longer))
    draw_result(layout.axes, result)
    draw_ends(layout.axes, result.problem)
    draw_annotations(layout, result, title)
    return layout.figure
