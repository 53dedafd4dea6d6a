"""Patches over maps of any size and resolution, for networks of any geometry."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import planformer as pf
from planformer.encoding import NetworkScale, anchor_points, region_mask
from planformer.errors import InvalidParameter
from planformer.guidance import make_region
from planformer.guidance.region import connecting_threshold, spread
from planformer.planning import Problem, is_connected

SCALES = st.builds(
    NetworkScale,
    stride=st.just(8),
    patch=st.integers(1, 20),
    anchor_offset=st.integers(0, 7),
    query_stride=st.just(4),
)
SEEDS = st.integers(0, 2**32 - 1)


def random_map(rng, rows, cols, resolution=0.05, density=0.1):
    return pf.OccupancyGrid(rng.random((rows, cols)) < density, resolution, (1.0, 2.0, 0.5))


def probabilities(rng, grid, scale, levels):
    """One value a token, with many ties."""
    tokens = [
        max(1, int(np.ceil(size * grid.resolution / scale.resolution / scale.stride - 1e-6)))
        for size in grid.shape
    ]
    return (rng.integers(0, levels + 1, tokens) / levels).astype(np.float32)


@settings(max_examples=80)
@given(SCALES, st.integers(1, 40), st.integers(1, 40), SEEDS)
def test_spread_is_the_union_of_patches_at_every_threshold(scale, rows, cols, seed):
    rng = np.random.default_rng(seed)
    grid = random_map(rng, rows, cols)
    probability = probabilities(rng, grid, scale, levels=6)
    cells = spread(probability, grid, scale)
    assert cells.shape == grid.shape
    for threshold in (*np.unique(probability), 0.4, 0.99):
        union = region_mask(probability >= threshold, scale)[:rows, :cols]
        np.testing.assert_array_equal(cells >= threshold, union)
    everything = region_mask(np.ones(probability.shape, bool), scale)[:rows, :cols]
    np.testing.assert_array_equal(cells < 0, ~everything)


@settings(max_examples=60)
@given(
    SCALES,
    st.sampled_from([0.01, 0.03, 0.1, 0.25, 1.0]),
    st.integers(1, 30),
    st.integers(1, 30),
    SEEDS,
)
def test_spread_at_other_resolutions_goes_by_the_cells_centres(scale, resolution, rows, cols, seed):
    rng = np.random.default_rng(seed)
    grid = random_map(rng, rows, cols, resolution)
    probability = probabilities(rng, grid, scale, levels=50)
    anchors = anchor_points(*(n * scale.stride for n in probability.shape), scale)
    # The patch of an odd number of pixels has its anchor half a pixel beside the middle.
    low = anchors - scale.patch // 2 * scale.resolution
    centres = np.stack(np.meshgrid(*((np.arange(n) + 0.5) * resolution for n in (cols, rows))), -1)
    offset, side = centres[:, :, None, None] - low, scale.patch * scale.resolution
    maybe = ((offset >= -1e-9) & (offset <= side + 1e-9)).all(-1)
    surely = ((offset >= 1e-9) & (offset <= side - 1e-9)).all(-1)
    cells = spread(probability, grid, scale)
    assert (cells <= np.where(maybe, probability, -1.0).max(axis=(2, 3))).all()
    assert (cells >= np.where(surely, probability, -1.0).max(axis=(2, 3))).all()


@settings(max_examples=80)
@given(SCALES, st.integers(2, 40), st.integers(2, 40), SEEDS)
def test_the_connecting_threshold_is_the_highest_that_connects(scale, rows, cols, seed):
    rng = np.random.default_rng(seed)
    grid = random_map(rng, rows, cols, density=0.2)
    free = grid.to_xy(np.argwhere(grid.free))
    start, goal = free[rng.integers(len(free), size=2)]
    problem = Problem(grid, pf.PointRobot(radius=0.0), tuple(start), tuple(goal))
    cells = spread(probabilities(rng, grid, scale, levels=9), grid, scale)
    connecting = [
        level
        for level in np.unique(cells[cells >= 0])
        if is_connected((cells >= level) & grid.free, problem)
    ]
    expected = max(connecting, default=None)
    assert connecting_threshold(cells, problem) == expected


@pytest.mark.parametrize("resolution", [0.02, 0.05, 0.1, 0.37])
@pytest.mark.parametrize("shape", [(1, 1), (20, 20), (21, 19), (60, 100)])
def test_the_mask_lies_in_the_squares_that_are_sampled(resolution, shape):
    scale, rng = NetworkScale(), np.random.default_rng(0)
    grid = random_map(rng, *shape, resolution, density=0.0)
    ends = grid.to_xy([(0, 0), (shape[0] - 1, shape[1] - 1)])
    problem = Problem(grid, pf.PointRobot(0.0), tuple(ends[0]), tuple(ends[1]))
    region = make_region(problem, probabilities(rng, grid, scale, 9), scale, threshold=0.6)
    assert region.mask.shape == grid.shape
    sampling = region.sampling()
    if sampling is None:
        assert not region.mask.any()
        return
    assert sampling.area == max(region.mask.sum(), 1) * resolution**2
    local = grid.frame.to_local(sampling.anchors)
    centres = (np.argwhere(region.mask)[:, ::-1] + 0.5) * resolution
    offset = np.abs(centres[:, None] - local).max(axis=-1)
    assert (offset.min(axis=1, initial=np.inf) <= sampling.half_width + 1e-9).all()


def test_double_precision_probabilities_select_what_the_mask_shows(room):
    # 0.1 rounds to another float32 than float64.
    region = make_region(room, np.full((4, 6), 0.1), NetworkScale(), threshold=0.1)
    assert region.selected.all()
    assert region.mask.all()


@pytest.mark.parametrize(
    "probability",
    [
        np.zeros(5),
        np.zeros((1, 4, 6)),
        np.zeros((0, 6)),
        np.full((4, 6), np.nan),
        np.full((4, 6), 1.5),
        np.full((4, 6), -0.5),
    ],
)
def test_what_is_no_probability_is_an_error(room, probability):
    with pytest.raises(InvalidParameter, match="probabilit"):
        make_region(room, probability.astype(np.float32), NetworkScale())


def test_headings_of_another_shape_are_an_error(room):
    probability = np.ones((4, 6), np.float32)
    with pytest.raises(InvalidParameter, match="headings"):
        make_region(room, probability, NetworkScale(), headings=np.zeros((6, 4)))
