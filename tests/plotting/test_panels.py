from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from matplotlib.collections import EllipseCollection, LineCollection

import planformer as pf
from planformer.errors import InvalidResults
from planformer.planning import Problem
from planformer.plotting.panels import (
    draw_anchors,
    draw_colour_bar,
    draw_headings,
    draw_mask,
    draw_plan,
    draw_scene,
    make_panels,
)


def problem(width=4.0, height=2.0):
    grid = pf.OccupancyGrid(np.zeros((round(height / 0.1), round(width / 0.1)), bool), 0.1)
    return Problem(grid, pf.PointRobot(0.1), (0.5, 0.5), (width - 0.5, height - 0.5))


def metres_per_inch(axes):
    box, size = axes.get_position(), axes.figure.get_size_inches()
    (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
    return (right - left) / (box.width * size[0]), (high - low) / (box.height * size[1])


def test_all_maps_have_one_scale_and_lie_in_the_figure():
    problems = [problem(*size) for size in ((4, 2), (3, 3), (6, 1), (2, 5))]
    _, panels = make_panels(problems, columns=2, width=8.0)
    assert len(panels) == 4
    for axes, one in zip(panels, problems, strict=True):
        draw_scene(axes, one, "title", "detail")
        assert axes.get_position().x0 > 0
        assert axes.get_position().x1 < 1
        assert axes.get_position().y0 > 0
    scales = np.array([metres_per_inch(axes) for axes in panels])
    np.testing.assert_allclose(scales, scales[0, 0])
    assert panels[0].get_position().y0 > panels[2].get_position().y1


def test_a_scene_is_titled_and_shows_the_ends():
    _, (axes,) = make_panels([problem()], columns=1, width=4.0)
    draw_scene(axes, problem(), "MPT-RRT*", "12 vertices")
    assert [text.get_text() for text in axes.texts] == ["MPT-RRT*", "12 vertices"]
    marked = {tuple(np.ravel(line.get_xydata())) for line in axes.lines}
    assert marked == {(0.5, 0.5), (3.5, 1.5)}
    assert len(axes.images) == 1


def test_a_plan_shows_what_there_is(make_region, make_result, tree_of):
    one = problem()
    _, (axes,) = make_panels([one], columns=1, width=4.0)
    draw_plan(axes, make_result(one, [], solved=False))
    assert not axes.lines
    assert not axes.collections
    states = [(0.5, 0.5), (2.0, 1.5), (3.5, 1.5)]
    region = make_region(one, np.ones((2, 4)))
    draw_plan(axes, make_result(one, states, region=region, tree=tree_of(states)))
    outline, edges = axes.collections
    assert len(outline.get_paths()) == 1
    assert len(edges.get_paths()) == 2
    vertices, path = axes.lines
    assert len(vertices.get_xdata()) == len(path.get_xdata()) == 3


def test_the_mask_darkens_the_rest_of_the_map(make_region):
    one = problem()
    probability = np.zeros((2, 4))
    probability[0, 1] = 1.0
    region = make_region(one, probability)
    _, (axes,) = make_panels([one], columns=1, width=4.0)
    draw_mask(axes, one, region)
    opacity = axes.images[0].get_array()[..., 3]
    np.testing.assert_array_equal(opacity == 0, region.mask)
    draw_anchors(axes, region)
    np.testing.assert_allclose(axes.lines[0].get_xydata(), region.anchors[:1, 1])


def test_headings_are_ellipses_that_point_along_them(make_region):
    one = problem()
    probability = np.zeros((2, 4))
    probability[1, 2] = probability[0, 0] = 1.0
    region = dataclasses.replace(
        make_region(one, probability),
        headings=np.full((2, 4), 1.2),
        offsets=np.full((2, 4, 2), 0.1),
    )
    _, (axes,) = make_panels([one], columns=1, width=4.0)
    draw_headings(axes, region)
    ellipses, strokes = axes.collections
    assert isinstance(ellipses, EllipseCollection)
    assert isinstance(strokes, LineCollection)
    centres = region.anchors[region.selected] + 0.1
    np.testing.assert_allclose(ellipses.get_offsets(), centres)
    for (start, end), centre in zip(strokes.get_segments(), centres, strict=True):
        np.testing.assert_allclose(start, centre)
        assert np.arctan2(*(end - start)[::-1]) == pytest.approx(1.2)


def test_a_region_without_anchors_or_headings_has_no_ellipses(make_region):
    one = problem()
    _, (axes,) = make_panels([one], columns=1, width=4.0)
    for value in (0.0, 1.0):
        draw_headings(axes, make_region(one, np.full((2, 4), value)))
    assert not axes.collections


def test_the_colour_bar_runs_from_0_to_1():
    figure, (axes,) = make_panels([problem()], columns=1, width=4.0)
    draw_colour_bar(axes)
    assert [text.get_text() for text in figure.axes[-1].texts] == ["probability  0", "1"]


def test_no_panels_are_refused():
    with pytest.raises(InvalidResults, match="one panel"):
        make_panels([], columns=2, width=8.0)
