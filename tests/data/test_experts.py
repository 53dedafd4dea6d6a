from __future__ import annotations

import math

import numpy as np
import pytest

from planformer.data.experts import shortest_path
from planformer.errors import InvalidParameter
from planformer.geometry import polyline_length
from planformer.maps.grid import OccupancyGrid


@pytest.fixture
def walled():
    """A 4 m x 4 m map, turned and moved, with a wall at x = 2 m (own frame) open at its top."""
    occupied = np.zeros((80, 80), bool)
    occupied[:60, 40] = True
    return OccupancyGrid(occupied, 0.05, origin=(10.0, -5.0, 0.6))


def test_the_path_goes_round_the_wall_from_the_exact_start_to_the_exact_goal(walled):
    start, goal = walled.frame.to_world([(1.01, 1.02), (3.03, 1.04)])
    path = shortest_path(walled, 0.1, start, goal)
    assert path is not None
    np.testing.assert_array_equal(path[[0, -1]], [start, goal])
    # Taut round the robot's corners at the wall's end: rows of cells from 62 on are free there.
    corners = [(1.01, 1.02), (1.875, 3.075), (2.175, 3.075), (3.03, 1.04)]
    assert polyline_length(path) == pytest.approx(polyline_length(corners), rel=0.01)
    between = np.linspace(path[:-1], path[1:], 500).reshape(-1, 2)
    rows, columns = walled.to_rc(between).T
    assert not walled.blocked(0.1)[rows, columns].any()


def test_none_where_nothing_joins_the_points(walled):
    inside, other_side = walled.frame.to_world([(1.0, 1.0), (3.0, 1.0)])
    assert shortest_path(walled, 1.1, inside, other_side) is None
    assert shortest_path(walled, 0.1, inside, (100.0, 0.0)) is None
    assert shortest_path(walled, 0.1, (math.nan, 0.0), inside) is None
    assert shortest_path(walled, 0.1, inside, walled.frame.to_world((2.02, 1.0))) is None


@pytest.mark.parametrize("bad", [(1.0,), (1.0, 2.0, 3.0), 1.0])
def test_a_point_of_another_shape_is_an_error(walled, bad):
    with pytest.raises(InvalidParameter, match=r"\(x, y\)"):
        shortest_path(walled, 0.1, (1.0, 1.0), bad)
    with pytest.raises(InvalidParameter, match=r"\(x, y\)"):
        shortest_path(walled, 0.1, bad, (1.0, 1.0))
