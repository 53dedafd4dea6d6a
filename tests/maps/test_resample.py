from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from planformer.errors import InvalidMap
from planformer.maps import OccupancyGrid

masks = st.tuples(st.integers(1, 20), st.integers(1, 20)).flatmap(
    lambda s: st.tuples(arrays(bool, s), arrays(bool, s))
)


@given(masks, st.floats(1.01, 5.0))
def test_a_free_coarser_cell_was_free_all_over(layers, ratio):
    occupied, unknown = layers
    grid = OccupancyGrid(occupied | unknown, 1.0, (1.0, 2.0, 0.4), unknown)
    coarse = grid.resampled(ratio)
    assert coarse.origin == grid.origin
    rows, columns = grid.shape
    for r, c in np.ndindex(coarse.shape):
        inside = (
            (slice(math.floor(r * ratio + 1e-6), math.ceil((r + 1) * ratio - 1e-6))),
            (slice(math.floor(c * ratio + 1e-6), math.ceil((c + 1) * ratio - 1e-6))),
        )
        beyond = inside[0].stop > rows or inside[1].stop > columns
        assert coarse.occupied[r, c] == (grid.occupied[inside].any() or beyond)
        seen = (grid.occupied & ~grid.unknown)[inside].any()
        assert coarse.unknown[r, c] == (grid.unknown[inside].any() and not seen)


@given(masks, st.floats(0.2, 0.99))
def test_a_finer_cell_is_what_lies_at_its_centre(layers, ratio):
    occupied, unknown = layers
    grid = OccupancyGrid(occupied, 1.0, unknown=unknown)
    fine = grid.resampled(ratio)
    rc = np.argwhere(np.ones(fine.shape, bool))
    old = np.minimum(np.floor((rc + 0.5) * ratio).astype(int), np.array(grid.shape) - 1)
    np.testing.assert_array_equal(fine.occupied.ravel(), grid.occupied[tuple(old.T)])
    np.testing.assert_array_equal(fine.unknown.ravel(), grid.unknown[tuple(old.T)])


@pytest.mark.parametrize("factor", [2, 3, 4, 5, 7])
def test_whole_ratios_divide_and_come_back(factor):
    grid = OccupancyGrid(np.random.default_rng(1).random((9, 14)) < 0.3, 0.05)
    fine = grid.resampled(0.05 / factor)
    assert fine.shape == (9 * factor, 14 * factor)
    np.testing.assert_array_equal(fine.resampled(0.05).occupied, grid.occupied)


@pytest.mark.parametrize(("size", "resolution", "cells"), [(480, 0.15, 160), (481, 0.1, 241)])
def test_number_of_cells(size, resolution, cells):
    grid = OccupancyGrid(np.zeros((size, size)), 0.05)
    assert grid.resampled(resolution).shape == (cells, cells)


def test_the_same_resolution_is_the_same_map():
    grid = OccupancyGrid(np.eye(3), 0.05)
    assert grid.resampled(0.05) is grid


def test_a_map_of_one_cell_can_be_resampled():
    grid = OccupancyGrid([[0]], 0.05)
    assert grid.resampled(0.01).shape == (5, 5)
    assert grid.resampled(1.0).occupied.tolist() == [[True]]


@pytest.mark.parametrize("resolution", [0.0, -1.0, math.nan, math.inf])
def test_bad_resolutions_are_rejected(resolution):
    with pytest.raises(InvalidMap, match="resolution"):
        OccupancyGrid([[0]]).resampled(resolution)
