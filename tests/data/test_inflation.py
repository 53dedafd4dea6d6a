from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from planformer.data.inflation import inflate
from planformer.maps.forest import generate_forest
from planformer.maps.grid import OccupancyGrid

maps = hnp.arrays(np.bool_, hnp.array_shapes(min_dims=2, max_dims=2, max_side=30))


@given(maps, st.sampled_from([0.02, 0.05, 0.1, 1 / 3]), st.floats(0.0, 8.0))
def test_it_equals_the_grid_for_any_radius(occupied, resolution, cells):
    radius = cells * resolution
    expected = OccupancyGrid(occupied, resolution).blocked(radius)
    np.testing.assert_array_equal(inflate(occupied, resolution, radius), expected)


@given(maps, st.sampled_from([0.02, 0.05, 0.1, 1 / 3]), st.sampled_from([1, 2, 8, 13, 25, 50]))
def test_it_equals_the_grid_where_a_distance_is_the_radius(occupied, resolution, squared):
    radius = squared**0.5 * resolution
    expected = OccupancyGrid(occupied, resolution).blocked(radius)
    np.testing.assert_array_equal(inflate(occupied, resolution, radius), expected)


def test_it_equals_the_grid_at_the_scale_of_training():
    grid = generate_forest(8)
    np.testing.assert_array_equal(inflate(grid.occupied, 0.05, 0.1), grid.blocked(0.1))


@pytest.mark.parametrize(("radius", "blocked"), [(0.1, 13), (0.099, 9), (0.05, 5), (0.0, 1)])
def test_a_single_cell_grows_to_a_disc(radius, blocked):
    occupied = np.zeros((15, 15), bool)
    occupied[7, 7] = True
    assert inflate(occupied, 0.05, radius)[3:-3, 3:-3].sum() == blocked
