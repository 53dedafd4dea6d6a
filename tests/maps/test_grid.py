from __future__ import annotations

import dataclasses
import math
import pickle
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.ndimage import distance_transform_edt

from planformer.errors import InvalidMap, InvalidParameter
from planformer.maps import OccupancyGrid

masks = st.tuples(st.integers(1, 12), st.integers(1, 12)).flatmap(lambda s: arrays(bool, s))
resolutions = st.sampled_from([0.01, 0.05, 0.1, 0.25, 1.0, 3.0])
origins = st.tuples(st.floats(-50, 50), st.floats(-50, 50), st.floats(-4, 4))
grids = st.builds(OccupancyGrid, masks, resolutions, origins)


def exact_clearance(grid: OccupancyGrid) -> np.ndarray:
    return distance_transform_edt(np.pad(grid.free, 1))[1:-1, 1:-1] * grid.resolution


def test_arrays_are_read_only_contiguous_copies():
    source = np.zeros((4, 3), bool)
    grid = OccupancyGrid(source[::-1].T[::2])
    source[:] = True
    assert not grid.occupied.any()
    for array in (grid.occupied, grid.unknown, grid.clearance, grid.blocked(0.1)):
        assert array.flags.c_contiguous
        assert not array.flags.writeable
    with pytest.raises(dataclasses.FrozenInstanceError):
        grid.resolution = 1.0  # type: ignore[misc]


def test_sizes_and_frame():
    grid = OccupancyGrid(np.zeros((2, 3)), 0.5, (1.0, 2.0))
    assert grid.shape == (2, 3)
    assert (grid.width, grid.height) == (1.5, 1.0)
    assert grid.origin == (1.0, 2.0, 0.0)
    assert (grid.frame.x, grid.frame.y, grid.frame.yaw) == (1.0, 2.0, 0.0)
    np.testing.assert_allclose(grid.to_xy((0, 0)), (1.25, 2.25))
    np.testing.assert_array_equal(grid.to_rc((2.3, 2.6)), (1, 2))


@pytest.mark.parametrize(
    "occupied",
    [
        np.zeros((0, 3)),
        np.zeros((3, 0)),
        np.zeros(4),
        np.zeros((2, 2, 2)),
        [[0.0, np.nan]],
        [[0, 2]],
        [[0, -1]],
        [[0.5]],
        [["a"]],
        [[1j]],
        3,
    ],
)
def test_bad_cells_are_rejected(occupied):
    with pytest.raises(InvalidMap, match="occupied"):
        OccupancyGrid(occupied)


@pytest.mark.parametrize(
    "resolution", [0.0, -1.0, math.nan, math.inf, "wide", None, 1e39, 1e-9, 10**400]
)
def test_bad_resolutions_are_rejected(resolution):
    with pytest.raises(InvalidMap, match="resolution"):
        OccupancyGrid([[0]], resolution)


@pytest.mark.parametrize("origin", [(0.0,), (0, 0, 0, 0), (0, math.nan), 5, ("a", 0), None])
def test_bad_origins_are_rejected(origin):
    with pytest.raises(InvalidMap, match="origin"):
        OccupancyGrid([[0]], 1.0, origin)


def test_unknown_must_fit():
    with pytest.raises(InvalidMap, match="unknown"):
        OccupancyGrid([[0]], unknown=[[0, 0]])


@given(grids, st.data())
def test_cells_and_world_points_round_trip(grid, data):
    rows, columns = grid.shape
    rc = data.draw(st.tuples(st.integers(-20, rows + 20), st.integers(-20, columns + 20)))
    xy = grid.to_xy(rc)
    np.testing.assert_array_equal(grid.to_rc(xy), rc)
    assert bool(grid.contains(xy)) == (0 <= rc[0] < rows and 0 <= rc[1] < columns)


@given(grids, st.tuples(st.floats(-100, 100), st.floats(-100, 100)))
def test_a_point_lies_in_its_cell(grid, xy):
    offset = grid.frame.to_local(grid.to_xy(grid.to_rc(xy))) - grid.frame.to_local(xy)
    assert np.abs(offset).max() <= grid.resolution / 2 + 1e-9
    rows, columns = grid.shape
    r, c = grid.to_rc(xy)
    assert bool(grid.contains(xy)) == (0 <= r < rows and 0 <= c < columns)


def test_coordinates_keep_their_leading_shape():
    grid = OccupancyGrid(np.zeros((5, 5)))
    assert grid.to_rc(np.zeros((2, 3, 2))).shape == (2, 3, 2)
    assert grid.to_xy(np.zeros((2, 3, 2))).shape == (2, 3, 2)
    assert grid.contains(np.zeros((2, 3, 2))).shape == (2, 3)


def test_points_that_are_no_points():
    grid = OccupancyGrid([[0]])
    assert not grid.contains([(math.nan, 0.0), (math.inf, 0.0), (1e300, 0.0)]).any()
    assert grid.to_rc((1e300, -1e300))[0] < 0
    with pytest.raises(InvalidParameter, match="finite"):
        grid.to_rc((math.nan, 0.0))
    with pytest.raises(InvalidParameter, match="shape"):
        grid.contains((0.0, 0.0, 0.0))


@given(grids)
def test_clearance_is_exact(grid):
    np.testing.assert_allclose(grid.clearance, exact_clearance(grid), rtol=1e-6)


@pytest.mark.parametrize("share", [0.0, 1e-6, 1e-4, 0.3])
def test_clearance_is_exact_on_large_maps(share):
    occupied = np.random.default_rng(0).random((1500, 1200)) < share
    grid = OccupancyGrid(occupied, 1.0)
    expected = exact_clearance(grid)
    assert share > 1e-5 or expected.max() > 255
    np.testing.assert_array_equal(np.rint(grid.clearance.astype(float) ** 2), np.rint(expected**2))


def test_a_wall_across_a_very_wide_map_stays_closed():
    occupied = np.zeros((40, 9000), bool)  # OpenCV 4.7 leaves holes beyond some 4,000 columns
    occupied[20] = True
    clearance = OccupancyGrid(occupied, 1.0).clearance
    assert not clearance[20].any()
    assert (clearance[19] == 1.0).all()


def test_more_cells_than_can_be_numbered_are_refused():
    with pytest.raises(InvalidMap, match=r"2,500,000,000 cells"):
        OccupancyGrid(np.broadcast_to(False, (50_000, 50_000)))


def test_clearance_counts_the_ring_outside():
    assert OccupancyGrid([[0]], 0.1).clearance[0, 0] == pytest.approx(0.1)
    np.testing.assert_allclose(OccupancyGrid(np.zeros((3, 5)), 1.0).clearance[1], [1, 2, 2, 2, 1])


@given(grids, st.floats(0, 20))
def test_blocked_is_clearance_up_to_the_radius(grid, radius):
    exact = exact_clearance(grid)
    blocked = grid.blocked(radius)
    assert blocked[exact <= radius].all()
    assert not blocked[exact > radius * (1 + 3e-6) + 1e-12].any()


@pytest.mark.parametrize("cells", range(1, 9))
@pytest.mark.parametrize("resolution", [0.05, 0.1, 0.025, 1 / 3])
def test_a_radius_of_whole_cells_blocks_the_last_of_them(cells, resolution):
    occupied = np.zeros((41, 41), bool)
    occupied[20, 20] = True
    blocked = OccupancyGrid(occupied, resolution).blocked(cells * resolution)
    assert blocked[20, 20 + cells]
    assert not blocked[20, 20 + cells + 1]


def test_blocked_by_radius_zero_is_occupied_and_the_last_answer_is_kept():
    grid = OccupancyGrid(np.eye(5))
    np.testing.assert_array_equal(grid.blocked(0.0), grid.occupied)
    assert grid.blocked(0.1) is grid.blocked(0.1)
    assert grid.blocked(0.0).sum() < grid.blocked(0.1).sum()


@pytest.mark.parametrize("radius", [-0.1, math.nan, math.inf])
def test_bad_radii_are_rejected(radius):
    with pytest.raises(InvalidParameter, match="radius"):
        OccupancyGrid([[0]]).blocked(radius)


@given(grids, st.tuples(st.floats(-80, 80), st.floats(-80, 80)), st.sampled_from([0.0, 0.1, 1.0]))
def test_nearest_free_is_the_nearest_of_all_free_cells(grid, xy, radius):
    free = np.argwhere(~grid.blocked(radius))
    found = grid.nearest_free(xy, radius)
    if len(free) == 0:
        assert found is None
        return
    r, c = grid.to_rc(found)
    assert not grid.blocked(radius)[r, c]
    best = np.linalg.norm(grid.to_xy(free) - xy, axis=1).min()
    assert math.dist(found, xy) == pytest.approx(best, abs=1e-9)


def test_nearest_free_across_a_large_obstacle():
    occupied = np.ones((300, 300), bool)
    occupied[290, 10] = False
    grid = OccupancyGrid(occupied, 1.0, (5.0, 5.0))
    assert grid.nearest_free((10.0, 10.0)) == (15.5, 295.5)
    assert grid.nearest_free((1e6, 1e6)) == (15.5, 295.5)


@given(arrays(np.int8, (3, 4), elements=st.integers(-1, 100)), st.booleans())
def test_ros_values_are_classified(values, unknown_is_occupied):
    grid = OccupancyGrid.from_ros(
        values.ravel(), 4, 3, 0.1, (1, 2, 0.5), unknown_is_occupied=unknown_is_occupied
    )
    unknown = (values == -1) | ((values > 25) & (values < 65))
    np.testing.assert_array_equal(grid.unknown, unknown)
    np.testing.assert_array_equal(
        grid.occupied, (values >= 65) | (unknown if unknown_is_occupied else False)
    )
    back = grid.to_ros()
    assert back.dtype == np.int8
    again = OccupancyGrid.from_ros(
        back, 4, 3, 0.1, (1, 2, 0.5), unknown_is_occupied=unknown_is_occupied
    )
    assert again == grid


@pytest.mark.parametrize(
    ("data", "width", "height"),
    [
        ([0, 0, 0], 2, 2),
        ([], 0, 0),
        ([101], 1, 1),
        ([-2], 1, 1),
        ([math.nan], 1, 1),
        (["a"], 1, 1),
        ([0], -1, -1),
    ],
)
def test_bad_ros_data_is_rejected(data, width, height):
    with pytest.raises(InvalidMap):
        OccupancyGrid.from_ros(data, width, height, 0.05)


def test_equality_and_hash():
    grid = OccupancyGrid(np.eye(3), 0.1, (1, 2))
    same = OccupancyGrid(np.eye(3).astype(bool), 0.1, (1, 2, 0), np.zeros((3, 3)))
    assert grid == same
    assert hash(grid) == hash(same)
    others = [
        OccupancyGrid(np.eye(3), 0.2, (1, 2)),
        OccupancyGrid(np.eye(3), 0.1, (1, 3)),
        OccupancyGrid(np.eye(3)[::-1], 0.1, (1, 2)),
        OccupancyGrid(np.eye(3), 0.1, (1, 2), np.eye(3)),
        "grid",
    ]
    assert all(grid != other for other in others)


def test_pickled_maps_come_back_read_only_and_without_caches():
    grid = OccupancyGrid(np.eye(200), 0.1, (1, 2, 3), np.eye(200)[::-1])
    size = len(pickle.dumps(grid))
    assert grid.blocked(0.3).any()
    assert len(pickle.dumps(grid)) == size
    copied = pickle.loads(pickle.dumps(grid))
    assert copied == grid
    assert not copied.occupied.flags.writeable


def test_repr_tells_what_matters():
    text = repr(OccupancyGrid(np.eye(4), 0.5, (1, 2, 3)))
    assert text == (
        "OccupancyGrid(4 x 4 cells, 2 x 2 m, resolution=0.5, origin=(1, 2, 3), "
        "occupied=25.0%, unknown=0.0%)"
    )


def test_a_map_of_one_cell():
    grid = OccupancyGrid([[0]], 0.05, (1.0, 1.0, 0.3))
    assert grid.nearest_free((0, 0)) == pytest.approx(tuple(grid.to_xy((0, 0))))
    assert grid.nearest_free((0, 0), 0.05) is None
    assert not grid.blocked(0.04).any()
    assert OccupancyGrid([[1]]).nearest_free((0, 0)) is None


def test_a_map_of_sixteen_million_cells():
    occupied = np.zeros((4000, 4000), bool)
    occupied[2000, 2000] = True
    grid = OccupancyGrid(occupied, 0.05)
    assert grid.clearance[1000, 2000] == pytest.approx(50.0)
    assert grid.clearance[2000, 3500] == pytest.approx(25.0)
    assert grid.nearest_free((100.025, 100.025)) is not None
    assert grid.resampled(1.0).shape == (200, 200)


def test_maps_import_with_numpy_alone():
    code = (
        "import sys, planformer.maps.grid; "
        "assert not {'cv2', 'PIL', 'yaml', 'matplotlib'} & set(sys.modules), 'heavy import'"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


@settings(max_examples=25)
@given(grids)
def test_random_maps_survive_every_question(grid):
    assert repr(grid)
    assert grid.clearance.shape == grid.shape
    assert grid.to_ros().shape == (grid.occupied.size,)


def test_components_are_the_parts_that_a_disc_cannot_leave():
    occupied = np.zeros((20, 30), bool)
    occupied[:, 10] = True
    occupied[4:6, 20] = True
    grid = OccupancyGrid(occupied, resolution=0.1)
    parts = grid.components(0.0)
    assert parts.shape == grid.shape
    assert not parts.flags.writeable
    assert ((parts == 0) == grid.blocked(0.0)).all()
    assert len(np.unique(parts[:, :10])) == len(np.unique(parts[10:, 11:])) == 1
    assert parts[0, 0] != parts[0, 29]
    assert grid.components(0.0) is parts  # kept
    assert not grid.components(2.0).any()  # fits nowhere
    with pytest.raises(InvalidParameter, match="radius"):
        grid.components(-1.0)
