from __future__ import annotations

import numpy as np
import pytest
from matplotlib.figure import Figure

import planformer as pf
from planformer.plotting import plot_result, style

ORIGINS = [(0.0, 0.0, 0.0), (-7.0, 3.0, 0.0), (2.0, -5.0, 0.6), (100.0, 50.0, -2.3)]


def grid_with_block(origin):
    """4 x 2 m, free but for a block in the middle and unknown space in a corner."""
    occupied = np.zeros((40, 80), bool)
    occupied[15:25, 30:50] = True
    unknown = np.zeros_like(occupied)
    unknown[:8, :10] = True
    return pf.OccupancyGrid(occupied | unknown, 0.05, origin, unknown)


def world(grid, *local):
    return grid.frame.to_world(np.array(local, float))


@pytest.mark.parametrize("origin", ORIGINS)
def test_everything_is_at_its_place_in_the_world(draw, make_result, origin):
    grid, robot = grid_with_block(origin), pf.PointRobot(0.1)
    start, goal = world(grid, (0.5, 1.0), (3.5, 1.0))
    problem = pf.Problem(grid, robot, start, goal)
    path = [start, *world(grid, (0.9, 1.6), (3.1, 1.6)), goal]
    picture = draw(make_result(problem, path))
    assert picture.shows(start, style.START)
    assert picture.shows(goal, style.GOAL)
    assert picture.shows(world(grid, (2.0, 1.6)), style.PATH)
    assert picture.shows(world(grid, (2.0, 1.0)), style.OBSTACLE)
    assert picture.shows(world(grid, (0.2, 0.2)), style.UNKNOWN)
    assert picture.shows(world(grid, (2.0, 0.4)), style.FLOOR)
    assert picture.shows(world(grid, (2.0, 0.69)), style.MARGIN)


@pytest.mark.parametrize("robot", [pf.DubinsCar(0.1, 0.3), pf.ReedsSheppCar(0.1, 0.3)])
def test_cars_have_headings_and_curved_trees(draw, make_result, tree_of, robot):
    grid = grid_with_block((1.0, 1.0, 0.5))
    start, goal = world(grid, (0.5, 1.0, 0.0), (3.5, 1.5, 1.0))
    problem = pf.Problem(grid, robot, start, goal)
    picture = draw(make_result(problem, [start, goal], tree=tree_of([start, goal])))
    assert picture.shows(start[:2], style.START)
    assert picture.shows(goal[:2], style.GOAL)


def test_heat_is_where_the_region_is(draw, make_region, make_result):
    grid, robot = grid_with_block((0.0, 0.0, 0.4)), pf.PointRobot(0.1)
    probability = np.zeros((4, 8))
    probability[0, 3:6] = 1.0
    problem = pf.Problem(grid, robot, *world(grid, (0.5, 1.5), (3.5, 1.5)))
    region = make_region(problem, probability)
    picture = draw(make_result(problem, [], region=region, solved=False))
    colours = style.heat_colours()(1.0)
    hot = style.rgb(style.FLOOR) * (1 - colours[3]) + np.array(colours[:3]) * colours[3]
    assert np.abs(picture.at(world(grid, (2.1, 0.3))) - hot).max() < 0.02
    assert picture.shows(world(grid, (1.0, 1.75)), style.FLOOR)
    assert picture.shows(world(grid, (2.0, 1.0)), style.OBSTACLE)


@pytest.mark.parametrize("shape", [(1, 1), (20, 20), (3, 1000), (1000, 3), (60, 40)])
def test_any_shape_gives_a_picture_of_readable_size(make_region, make_result, shape):
    grid = pf.OccupancyGrid(np.zeros(shape, bool), 0.05)
    start = goal = grid.to_xy((0, 0))
    problem = pf.Problem(grid, pf.PointRobot(0.0), start, goal)
    region = make_region(problem, np.full((1, 1), 0.7))
    figure = plot_result(make_result(problem, [start, goal], region=region), title="t")
    assert isinstance(figure, Figure)
    width, height = figure.get_size_inches() * figure.dpi
    assert 1000 <= width <= 2200
    assert 300 <= height <= 2400


def test_texts_tell_the_outcome(make_result):
    grid = grid_with_block((0.0, 0.0, 0.0))
    start, goal = (0.5, 1.0), (3.5, 1.0)
    problem = pf.Problem(grid, pf.PointRobot(), start, goal)
    texts = {}
    for solved in (True, False):
        result = make_result(problem, [start, goal] if solved else [], solved=solved)
        figure = plot_result(result, title="a title")
        texts[solved] = " ".join(text.get_text() for text in figure.texts)
    assert "a title" in texts[True]
    assert "path found" in texts[True]
    assert "1.00 m" in texts[True]
    assert "no path: time limit" in texts[False]
