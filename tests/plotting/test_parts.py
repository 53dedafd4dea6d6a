from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

import planformer as pf
from planformer.errors import InvalidParameter
from planformer.plotting import plot_result, save_picture
from planformer.plotting.annotations import nice_length
from planformer.plotting.layers import car_outlines, outline
from planformer.plotting.raster import heat_values, map_image
from planformer.plotting.view import View, make_view


def whole(grid):
    return View(grid, (0, grid.shape[0]), (0, grid.shape[1]))


@given(st.floats(1e-3, 1e6))
def test_nice_length_is_round_and_close(extent):
    length = nice_length(extent)
    assert extent / 2.6 <= length <= extent
    assert round(length / 10.0 ** np.floor(np.log10(length) + 1e-9), 9) in (1.0, 2.0, 5.0)


@settings(max_examples=40)
@given(arrays(bool, st.tuples(st.integers(1, 12), st.integers(1, 12))))
def test_outlines_enclose_the_mask(mask):
    grid = pf.OccupancyGrid(np.zeros(mask.shape, bool), 0.1)
    area = 0.0
    for line in outline(grid, mask):
        np.testing.assert_allclose(line[0], line[-1])
        x, y = line.T
        area += 0.5 * np.sum(x[:-1] * y[1:] - x[1:] * y[:-1])  # holes turn the other way
    # Corners are cut by half a pixel of the enlarged mask.
    assert abs(area) == pytest.approx(mask.sum() * 0.01, abs=1e-3)


@given(
    known=arrays(bool, st.tuples(st.integers(1, 30), st.integers(1, 30))),
    at=st.tuples(st.floats(0, 0.999), st.floats(0, 0.999)),
    yaw=st.floats(-3, 3),
)
def test_view_holds_what_was_observed_and_the_ends(known, at, yaw):
    grid = pf.OccupancyGrid(np.zeros(known.shape, bool), 0.1, (3.0, -2.0, yaw), ~known)
    row, column = (int(share * side) for share, side in zip(at, known.shape, strict=True))
    view = make_view(grid, [grid.to_xy((row, column))])
    assert view.of(known).sum() == known.sum()
    assert view.rows[0] <= row < view.rows[1] <= known.shape[0]
    assert view.columns[0] <= column < view.columns[1] <= known.shape[1]
    low, high = view.world_bounds()
    assert (low <= grid.to_xy((row, column))).all()
    assert (grid.to_xy((row, column)) <= high).all()


def test_view_cuts_unknown_space_off():
    unknown = np.ones((200, 300), bool)
    unknown[50:150, 100:200] = False
    view = make_view(pf.OccupancyGrid(unknown, unknown=unknown), [(7.0, 5.0)])
    assert view.shape == (110, 110)


@pytest.mark.parametrize("yaw", [0.0, 1.1])
def test_heat_equals_the_probability_at_the_anchors(make_region, yaw):
    grid = pf.OccupancyGrid(np.zeros((50, 100), bool), 0.1, (2.0, 3.0, yaw))
    problem = pf.Problem(grid, pf.PointRobot(), *grid.to_xy([(20, 20), (30, 30)]))
    probability = np.random.default_rng(0).random((5, 10))
    heat = heat_values(whole(grid), make_region(problem, probability), (250, 500))
    np.testing.assert_allclose(heat[24::50, 24::50], probability, atol=0.02)


def test_heat_moves_with_the_view(make_region):
    grid = pf.OccupancyGrid(np.zeros((50, 100), bool), 0.1)
    problem = pf.Problem(grid, pf.PointRobot(), (2.0, 2.0), (3.0, 3.0))
    region = make_region(problem, np.random.default_rng(0).random((5, 10)))
    part = heat_values(View(grid, (10, 30), (40, 90)), region, (20, 50))
    all_of_it = heat_values(whole(grid), region, (50, 100))
    # OpenCV interpolates at 32nds of a pixel.
    np.testing.assert_allclose(part, all_of_it[10:30, 40:90], atol=0.05)


def test_large_maps_shrink_and_keep_thin_walls():
    occupied = np.zeros((4000, 3000), bool)
    occupied[:, 1500] = True
    image = map_image(whole(pf.OccupancyGrid(occupied)), 0.0, None, pixels=1000)
    assert image.shape == (1000, 750, 3)
    darkest = image.min(axis=(1, 2))
    assert (darkest < 0.75 * image.max()).all()


def test_small_maps_grow_by_whole_factors():
    occupied = np.eye(20, dtype=bool)
    image = map_image(whole(pf.OccupancyGrid(occupied)), 0.0, None, pixels=1010)
    assert image.shape == (1000, 1000, 3)
    blocks = image.reshape(20, 50, 20, 50, 3)
    assert (blocks == blocks[:, :1, :, :1]).all()


@pytest.mark.parametrize("length", [0.0, 0.3, 10.0])
def test_car_outlines_lie_on_the_path_and_point_along_it(length):
    path = np.array([(0.0, 0.0, 0.5), (length * np.cos(0.5), length * np.sin(0.5), 0.5)])
    outlines = car_outlines(path, 0.2)
    assert len(outlines) == min(14, int(length / 0.8))
    for shape in outlines:
        tip, tail = shape[0], shape[2:4].mean(axis=0)
        assert np.arctan2(*(tip - tail)[::-1]) == pytest.approx(0.5)
        middle = 0.5 * (tip + tail)
        assert np.hypot(*(shape - middle).T).max() <= 0.2
        assert middle[0] * np.sin(0.5) == pytest.approx(middle[1] * np.cos(0.5))


@pytest.fixture
def figure(make_result):
    grid = pf.OccupancyGrid(np.zeros((20, 20), bool))
    problem = pf.Problem(grid, pf.PointRobot(), (0.2, 0.2), (0.8, 0.8))
    return plot_result(make_result(problem, [problem.start, problem.goal]))


def test_saved_picture_has_the_figures_size(figure, tmp_path):
    from PIL import Image

    save_picture(figure, tmp_path / "picture.png")
    with Image.open(tmp_path / "picture.png") as image:
        image.load()
        assert image.size == tuple((figure.get_size_inches() * figure.dpi).astype(int))
    assert [path.name for path in tmp_path.iterdir()] == ["picture.png"]


@pytest.mark.parametrize("name", ["picture.bmp", "picture", "missing/picture.png"])
def test_unwritable_pictures_are_refused(figure, tmp_path, name):
    with pytest.raises(InvalidParameter, match="picture"):
        save_picture(figure, tmp_path / name)
    assert not list(tmp_path.iterdir())
