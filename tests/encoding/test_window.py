from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import planformer as pf
from planformer.encoding import NetworkScale, QueryKind, encode_query, encode_windows, network_map
from planformer.encoding.window import MARGIN, TILE, Window, stitch, whole_map, windows_round

SCALE = NetworkScale(offsets=True)
SIDE = SCALE.stride // SCALE.query_stride


def _tokens(shape, *matters):
    pixels = np.zeros(np.multiply(shape, SIDE), bool)
    for row, col in matters:
        pixels[SIDE * row + 1, SIDE * col + 2] = True
    return pixels


def test_what_matters_lies_in_a_window_with_its_margin():
    (window,) = windows_round(_tokens((30, 20), (5, 4), (12, 9)), SCALE)
    assert window == Window(slice(5 - MARGIN, 13 + MARGIN), slice(4 - MARGIN, 10 + MARGIN))


def test_a_window_ends_where_the_map_ends():
    (window,) = windows_round(_tokens((30, 20), (0, 0), (29, 19)), SCALE)
    assert window == whole_map((30 * SCALE.stride, 20 * SCALE.stride), SCALE)


def test_nothing_that_matters_gives_no_window():
    assert windows_round(_tokens((30, 20)), SCALE) == []


@given(st.lists(st.tuples(st.integers(0, 119), st.integers(0, 89)), min_size=1, max_size=30))
def test_tiles_hold_all_that_matters_and_little_else(places):
    windows = windows_round(_tokens((120, 90), *places), SCALE)
    kept = np.zeros((1, 120, 90))
    assert all(max(window.shape) <= TILE + 2 * MARGIN for window in windows)
    stitch([(window, np.ones((1, *window.shape))) for window in windows], kept)
    assert all(kept[0, row, col] for row, col in places)
    assert len(windows) <= len(places)


def test_cut_and_paste():
    values = np.arange(6 * 8, dtype=float).reshape(1, 6, 8)
    window = Window(slice(1, 6), slice(2, 7))
    assert (window.cut(values, 1) == values[:, 1:6, 2:7]).all()
    assert (Window(slice(1, 3), slice(0, 2)).cut(values, 2) == values[:, 2:6, 0:4]).all()
    whole = np.zeros((1, 6, 8))
    stitch([(window, window.cut(values, 1))], whole)
    # The outermost tokens count only at the map's own edge, which is the last row here.
    assert (whole[:, 2:6, 3:6] == values[:, 2:6, 3:6]).all()
    assert not whole[:, :2].any()
    assert not whole[:, :, :3].any()
    assert not whole[:, :, 6:].any()


def test_no_margin_replaces_what_another_window_is_about():
    """In whatever order the windows come."""
    first, second = windows_round(
        _tokens((60, 90), (5, 5), (5, 5 + TILE - 1), (5, 5 + TILE)), SCALE
    )
    assert first.cols.stop > second.cols.start + 2 * MARGIN - 1  # they overlap
    parts = [(window, np.full((1, *window.shape), i)) for i, window in enumerate((first, second))]
    for order in (parts, parts[::-1]):
        whole = np.full((1, 60, 90), -1)
        stitch(order, whole)
        assert whole[0, 5, 5 : 5 + TILE + 1].tolist() == [0] * TILE + [1]


@pytest.mark.parametrize("kind", list(QueryKind))
def test_windows_hold_parts_of_the_whole_query(kind):
    scale = NetworkScale(query=kind, query_stride=1 if kind is QueryKind.SQUARE else 5)
    grid = pf.generate_forest(seed=5, width=60.0, height=50.0)
    pixels = network_map(grid.blocked(0.1), grid.resolution, scale)
    pixels[:60] = pixels[-60:] = 0
    start, goal = (2.0, 1.0), (50.0, 49.0)
    whole = encode_query(pixels, start, goal, scale)
    windows = encode_windows(pixels, start, goal, scale)
    assert len(windows) == 1 if kind is not QueryKind.WAVEFRONT else len(windows) > 1
    for window, query in windows:
        part = window.cut(whole, scale.stride // scale.query_stride)
        np.testing.assert_array_equal(query, part)


def test_without_a_way_the_window_is_the_whole_map():
    pixels = np.zeros((480, 480), np.uint8)
    pixels[:, 240:260] = 1
    ((window, _),) = encode_windows(pixels, (2.0, 2.0), (20.0, 20.0), SCALE)
    assert window == whole_map(pixels.shape, SCALE)


@pytest.mark.parametrize("guide", ["mpt", "mpt-dubins"])
def test_a_prediction_in_windows_is_that_of_the_whole_map(guide):
    """Where the way leads, but for what a network makes of the edges."""
    from planformer.guidance import load_network

    network = load_network(guide)
    grid = pf.generate_forest(seed=3)
    robot = pf.PointRobot(radius=0.1)
    if guide == "mpt-dubins":
        robot = pf.DubinsCar(radius=0.1, turning_radius=0.4)
    ends = (4.0, 4.0, 0.0), (14.0, 9.0, 0.0)
    free = np.argwhere(~grid.blocked(0.3))
    near = [grid.to_xy(free[np.abs(grid.to_xy(free) - e[:2]).sum(1).argmin()]) for e in ends]
    problem = pf.Problem(
        grid, robot, *[(*xy, *([0.0] * (robot.state_dimension - 2))) for xy in near]
    )
    scale = network.scale
    pixels = network_map(problem.blocked, grid.resolution, scale)
    local = problem.local_start, problem.local_goal
    query = encode_query(pixels, *local, scale)
    whole = network.session.run(None, {"map": pixels[None, None], "query": query[None]})[0][0, 0]
    (window, _), *others = encode_windows(pixels, *local, scale)
    assert not others
    assert np.prod(window.shape) < 0.7 * whole.size
    difference = np.abs(network.predict(problem).probability - whole)
    way = encode_query(pixels, *local, scale)[4].reshape(whole.shape[0], SIDE, -1, SIDE).max((1, 3))
    assert difference[way > 0.5].max() < 0.1
