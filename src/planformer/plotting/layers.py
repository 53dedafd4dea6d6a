"""The map and what lies on it: the region's outline, the search tree, the path, start and goal."""

from __future__ import annotations

import contourpy
import numpy as np
from matplotlib import patheffects
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.markers import MarkerStyle
from matplotlib.path import Path
from matplotlib.transforms import Affine2D
from numpy.typing import NDArray

from planformer.geometry import polyline_length
from planformer.guidance import Region
from planformer.maps import OccupancyGrid
from planformer.planning import PlanResult, Problem, Tree, edge_lines
from planformer.plotting import style
from planformer.plotting.raster import image_shape, map_image, resized
from planformer.plotting.view import View
from planformer.robots import Robot

_OUTLINE_PIXELS = 1600
_MAX_EDGES = 60_000
"""Beyond this a tree is a solid area, and drawing it takes seconds."""
_MIN_OPACITY, _MAX_OPACITY = 0.06, 0.7
_SPARSE = 30.0
"""Length of a tree in diagonals of its extent up to which it is drawn with full opacity."""
_DART = np.array([(1.0, 0.0), (-0.8, 0.72), (-0.42, 0.0), (-0.8, -0.72)])
_CAR = np.array([(0.9, 0.0), (0.62, 0.42), (-0.9, 0.42), (-0.9, -0.42), (0.62, -0.42)])
"""Outline of a car inside its disc of radius 1, pointed at the front."""
_CARS = 14


def draw_map(axes: Axes, view: View, radius: float, region: Region | None, *, pixels: int) -> None:
    """Draw the part of a map that a view shows; the arguments are those of `map_image`."""
    x, y, yaw = view.grid.origin
    image = axes.imshow(
        map_image(view, radius, region, pixels=pixels),
        origin="lower",
        extent=view.extent,
        interpolation="antialiased",
        aspect="equal",
        zorder=1,
    )
    image.set_transform(Affine2D().rotate(yaw).translate(x, y) + axes.transData)


def draw_result(axes: Axes, result: PlanResult) -> None:
    """Draw region, search tree and path of a plan, as far as they are there."""
    problem = result.problem
    if result.region is not None:
        draw_region(axes, problem.grid, result.region)
    if result.tree is not None:
        draw_tree(axes, problem.robot, result.tree)
    if result.solved:
        draw_path(axes, problem.robot, result.path)


def draw_region(axes: Axes, grid: OccupancyGrid, region: Region) -> None:
    """Draw the outline of the region."""
    lines = [grid.frame.to_world(line) for line in outline(grid, region.mask)]
    axes.add_collection(
        LineCollection(
            lines, colors=style.REGION, linewidths=0.9, alpha=0.75, joinstyle="round", zorder=2
        )
    )


def outline(grid: OccupancyGrid, mask: NDArray[np.bool_]) -> list[NDArray[np.float64]]:
    """Closed outlines (N, 2) of a (H, W) bool mask, metres in the map's own frame."""
    rows, columns = image_shape(mask.shape, _OUTLINE_PIXELS)
    padded = np.pad(resized(mask, (rows, columns)), 1)
    x = (np.arange(columns + 2) - 0.5) * (grid.width / columns)
    y = (np.arange(rows + 2) - 0.5) * (grid.height / rows)
    lines = contourpy.contour_generator(x, y, padded).lines(0.5)
    return [np.clip(np.asarray(line), 0.0, (grid.width, grid.height)) for line in lines]


def draw_tree(axes: Axes, robot: Robot, tree: Tree) -> None:
    """Draw the search tree: straight edges for a point robot, curves for a car."""
    edges = tree.edges[:: -(-len(tree.edges) // _MAX_EDGES) or 1]
    lines = edge_lines(robot, tree.vertices, edges)
    axes.add_collection(
        LineCollection(
            lines, colors=style.TREE, linewidths=0.45, alpha=_tree_opacity(lines), zorder=3
        )
    )


def _tree_opacity(lines: list[NDArray[np.float64]]) -> float:
    """Lower for a dense tree, so that the heat map shows through."""
    if not lines:
        return _MAX_OPACITY
    length = sum(polyline_length(line) for line in lines)
    extent = np.ptp(np.concatenate(lines), axis=0)
    # Length for its extent, in lengths of a stroke along it: 1 = drawn once.
    density = length / max(float(np.hypot(*extent)), 1e-9)
    return float(np.clip(_MAX_OPACITY * (_SPARSE / density) ** 0.5, _MIN_OPACITY, _MAX_OPACITY))


def draw_path(axes: Axes, robot: Robot, path: NDArray[np.float64]) -> None:
    """Draw a path, (N, 2) or (N, 3), with a halo and, for a car, some outlines of it along it."""
    halo = patheffects.withStroke(linewidth=5.4, foreground=style.HALO, alpha=0.9)
    axes.plot(
        *path[:, :2].T,
        color=style.PATH,
        linewidth=2.5,
        solid_capstyle="round",
        solid_joinstyle="round",
        path_effects=[halo],
        zorder=4,
    )
    if robot.state_dimension == 3:
        # A small robot on a large map is drawn larger than it is: its heading must be seen.
        size = max(robot.radius, 0.009 * max(np.ptp(axes.get_xlim()), np.ptp(axes.get_ylim())))
        axes.add_collection(
            PolyCollection(
                car_outlines(path, size),
                facecolors=style.HALO,
                edgecolors=style.PATH,
                linewidths=1.1,
                zorder=5,
            )
        )


def car_outlines(path: NDArray[np.float64], size: float) -> list[NDArray[np.float64]]:
    """(5, 2) outlines in metres of a car in a disc of radius `size`, evenly spaced along a path."""
    steps = np.hypot(*np.diff(path[:, :2], axis=0).T)
    along = np.concatenate(([0.0], np.cumsum(steps)))
    count = min(_CARS, int(along[-1] / (4.0 * size)))
    # Both ends have markers of their own.
    wanted = np.linspace(0.0, along[-1], count + 2)[1:-1]
    x, y = (np.interp(wanted, along, path[:, axis]) for axis in (0, 1))
    # Poses are dense on arcs, and on a straight line both ends have its yaw.
    yaw = path[np.searchsorted(along, wanted), 2]
    return [_placed(_CAR * size, pose) for pose in np.column_stack((x, y, yaw))]


def _placed(shape: NDArray[np.float64], pose: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.asarray(Affine2D().rotate(pose[2]).translate(*pose[:2]).transform(shape))


def draw_ends(axes: Axes, problem: Problem) -> None:
    """Mark start and goal: a disc and a star, for a car an arrowhead along each heading."""
    for state, colour, symbol, size in (
        (problem.start, style.START, "o", 11.5),
        (problem.goal, style.GOAL, "*", 18.0),
    ):
        is_pose = len(state) == 3
        axes.plot(
            *state[:2],
            marker=_dart(state[2]) if is_pose else symbol,
            markersize=19.0 if is_pose else size,
            markerfacecolor=colour,
            markeredgecolor=style.HALO,
            markeredgewidth=1.6,
            linestyle="none",
            clip_on=False,
            zorder=6,
        )


def _dart(yaw: float) -> MarkerStyle:
    return MarkerStyle(Path(_DART, closed=False), transform=Affine2D().rotate(yaw))
