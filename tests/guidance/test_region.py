from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import planformer as pf
from planformer.encoding import NetworkScale, region_mask
from planformer.errors import InvalidParameter
from planformer.guidance.region import RELAXATION, connecting_threshold, make_region, spread
from planformer.planning import Problem, is_connected

SCALE = NetworkScale()
PAPER_SCALE = NetworkScale(anchor_offset=4)


def _probability(seed, shape):
    return np.random.default_rng(seed).random(shape).astype(np.float32)


@given(
    seed=st.integers(0, 2**32 - 1),
    shape=st.tuples(st.integers(1, 5), st.integers(1, 5)),
    threshold=st.floats(0, 1),
    scale=st.sampled_from([SCALE, PAPER_SCALE]),
)
def test_thresholding_the_spread_is_the_union_of_patches(seed, shape, threshold, scale):
    probability = _probability(seed, shape)
    grid = pf.OccupancyGrid(np.zeros((shape[0] * 20, shape[1] * 20), bool), 0.05)
    expected = region_mask(probability >= threshold, scale)
    np.testing.assert_array_equal(spread(probability, grid, scale) >= threshold, expected)


@pytest.mark.parametrize(("resolution", "cells"), [(0.1, (35, 47)), (0.025, (140, 188))])
def test_the_mask_has_the_resolution_of_the_map(resolution, cells):
    grid = pf.OccupancyGrid(np.zeros(cells, bool), resolution)
    probability = np.zeros((4, 5), np.float32)
    probability[1, 2] = 1.0  # anchor at (2.5, 1.5) m, patch of 1.6 m
    rows, cols = np.nonzero(spread(probability, grid, SCALE) >= 0.5)
    x, y = (cols + 0.5) * resolution, (rows + 0.5) * resolution
    assert x.min() == pytest.approx(1.7, abs=resolution)
    assert x.max() == pytest.approx(3.3, abs=resolution)
    assert y.min() == pytest.approx(0.7, abs=resolution)
    assert y.max() == pytest.approx(2.3, abs=resolution)


@pytest.mark.parametrize("seed", range(20))
def test_the_connecting_threshold_is_the_highest_that_connects(room, seed):
    cells = spread(_probability(seed, (4, 6)), room.grid, SCALE)
    found = connecting_threshold(cells, room)
    levels = np.unique(cells[cells >= 0])
    free = ~room.blocked
    connecting = [level for level in levels if is_connected((cells >= level) & free, room)]
    assert found == pytest.approx(max(connecting))


def test_a_region_connects_start_and_goal_through_the_door(room):
    probability = _probability(3, (4, 6))
    region = make_region(room, probability, SCALE)
    cells = spread(probability, room.grid, SCALE)
    assert region.connected
    assert region.threshold == pytest.approx(RELAXATION * connecting_threshold(cells, room))
    assert region.mask.shape == room.grid.shape
    assert region.share == region.mask.mean()
    assert region.anchors.shape == (4, 6, 2)


def test_a_fixed_threshold_is_kept_whatever_it_connects(room):
    region = make_region(room, np.full((4, 6), 0.4, np.float32), SCALE, threshold=0.5)
    assert region.threshold == 0.5
    assert not region.connected
    assert not region.mask.any()
    assert region.sampling() is None


def test_a_map_in_two_parts_is_reported():
    occupied = np.zeros((80, 120), bool)
    occupied[:, 60] = True
    problem = Problem(pf.OccupancyGrid(occupied), pf.PointRobot(), (1.0, 2.0), (5.0, 2.0))
    region = make_region(problem, _probability(1, (4, 6)), SCALE)
    assert not region.connected
    assert region.threshold == 0.5 * RELAXATION


def test_samples_are_drawn_round_the_selected_anchors_in_the_world_frame(room):
    probability = np.zeros((4, 6), np.float32)
    probability[2, 3] = 1.0
    region = make_region(room, probability, SCALE, threshold=0.5)
    sampling = region.sampling()
    expected = room.grid.frame.to_world([[3.5, 2.5]])
    np.testing.assert_allclose(sampling.anchors, expected)
    assert sampling.half_width == pytest.approx(0.8)
    assert sampling.headings is None
    assert sampling.area == pytest.approx(1.6**2)


def test_offsets_turn_with_the_map_and_stay_in_the_patch(room):
    offsets = np.zeros((4, 6, 2))
    offsets[...] = 0.5, -3.0
    region = make_region(room, np.ones((4, 6), np.float32), SCALE, offsets=offsets, threshold=0.5)
    centres = region.sampling().anchors + region.sampling().offsets
    local = room.grid.frame.to_local(region.sampling().anchors) + (0.5, -0.8)
    np.testing.assert_allclose(centres, room.grid.frame.to_world(local), atol=1e-12)


def test_offsets_of_another_shape_are_refused(room):
    with pytest.raises(InvalidParameter, match=r"offsets must have the shape \(4, 6, 2\)"):
        make_region(room, np.ones((4, 6), np.float32), SCALE, offsets=np.zeros((4, 6)))


def test_headings_turn_with_the_map(room):
    region = make_region(
        room, np.ones((4, 6), np.float32), SCALE, headings=np.full((4, 6), 0.5), threshold=0.5
    )
    np.testing.assert_allclose(region.sampling().headings, 0.5 + room.grid.frame.yaw)


@pytest.mark.parametrize("shape", [(6, 4), (4, 5), (5, 6), (1, 1)])
def test_anchors_of_another_map_are_refused(room, shape):
    with pytest.raises(InvalidParameter, match=r"probability must have the shape \(4, 6\)"):
        make_region(room, np.ones(shape, np.float32), SCALE)
