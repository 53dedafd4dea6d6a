from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from planformer.encoding import NetworkScale, network_map
from planformer.errors import InvalidMap, InvalidParameter

SCALE = NetworkScale()
SHAPES = st.tuples(st.integers(1, 45), st.integers(1, 45))
MAPS = SHAPES.flatmap(lambda shape: arrays(bool, shape))


@given(MAPS)
def test_keeps_a_map_of_its_own_resolution_and_pads_top_and_right(blocked):
    pixels = network_map(blocked, SCALE.resolution, SCALE)
    height, width = blocked.shape
    assert pixels.dtype == np.uint8
    assert pixels.shape == (SCALE.padded(height), SCALE.padded(width))
    assert np.array_equal(pixels[:height, :width], blocked)
    assert pixels[height:].all()
    assert pixels[:, width:].all()


@given(MAPS, st.sampled_from([2, 3, 5]))
def test_repeats_coarser_cells(blocked, factor):
    pixels = network_map(blocked, factor * SCALE.resolution, SCALE)
    repeated = blocked.repeat(factor, 0).repeat(factor, 1)
    assert np.array_equal(pixels[: repeated.shape[0], : repeated.shape[1]], repeated)


@given(MAPS, st.floats(0.011, 0.3))
def test_loses_no_blocked_cell(blocked, resolution):
    pixels = network_map(blocked, resolution, SCALE)
    rows, cols = np.nonzero(blocked)
    centres = ((axis + 0.5) * resolution / SCALE.resolution for axis in (rows, cols))
    assert pixels[tuple(np.floor(axis).astype(int) for axis in centres)].all()


@given(MAPS, st.floats(0.011, 0.3))
def test_a_pixel_inside_free_cells_is_free(blocked, resolution):
    free = network_map(np.zeros_like(blocked), resolution, SCALE)
    height, width = (int(size * resolution / SCALE.resolution) for size in blocked.shape)
    assert not free[:height, :width].any()


def test_finer_cells_block_any_pixel_that_they_touch():
    blocked = np.zeros((40, 40), bool)
    blocked[7, 10] = True  # at 0.02 m this cell spans 0.14-0.16 m and 0.20-0.22 m
    pixels = network_map(blocked, 0.02, SCALE)
    assert np.argwhere(pixels[:16, :16]).tolist() == [[2, 4], [3, 4]]


@pytest.mark.parametrize("blocked", [np.zeros(4, bool), np.zeros((0, 3), bool)])
def test_refuses_what_is_no_map(blocked):
    with pytest.raises(InvalidMap):
        network_map(blocked, 0.05, SCALE)


@pytest.mark.parametrize("resolution", [0.0, -1.0, float("nan"), float("inf")])
def test_refuses_an_impossible_resolution(resolution):
    with pytest.raises(InvalidParameter):
        network_map(np.zeros((3, 3), bool), resolution, SCALE)


def test_cells_far_finer_than_a_pixel_become_one():
    assert network_map(np.eye(3, dtype=bool), 1e-21, SCALE)[0, 0] == 1
    assert network_map(np.zeros((3, 3), bool), 1e-21, SCALE)[0, 0] == 0


@pytest.mark.parametrize(("query", "cells"), [("wavefront", 410), ("square", 103)])
def test_few_cells_of_a_great_size_are_too_many_pixels(query, cells):
    scale = NetworkScale(query=query, query_stride=5 if query == "wavefront" else 1)
    with pytest.raises(InvalidMap, match=f"{20 * cells} x {20 * cells} pixels"):
        network_map(np.zeros((cells, cells), bool), 20 * scale.resolution, scale)
