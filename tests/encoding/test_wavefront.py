from __future__ import annotations

import heapq
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from planformer.encoding.wavefront import detours, relaxed_detours
from planformer.maps import generate_forest, generate_maze


@st.composite
def _grids(draw):
    shape = draw(st.tuples(st.integers(1, 12), st.integers(1, 12)))
    blocked = draw(arrays(bool, shape, elements=st.sampled_from([False, False, True])))
    ends = (tuple(draw(st.integers(0, size - 1)) for size in shape) for _ in range(2))
    limit = draw(st.sampled_from([0.0, 0.5, 2.0, 3.7, 1e3]))
    return blocked, *ends, limit, draw(st.integers(1, 5))


def _dijkstra(blocked, source):
    """The textbook, with rules spelled out."""

    def free(row, col):
        inside = 0 <= row < blocked.shape[0] and 0 <= col < blocked.shape[1]
        return inside and not blocked[row, col]

    distance = {source: 0.0}
    queue = [(0.0, source)]
    while queue:
        length, (row, col) = heapq.heappop(queue)
        for dr, dc in np.ndindex(3, 3):
            dr, dc = dr - 1, dc - 1
            target = row + dr, col + dc
            if not (free(*target) and ((dr, dc) != (0, 0))):
                continue
            if dr and dc and not (free(row + dr, col) and free(row, col + dc)):
                continue
            if length + math.hypot(dr, dc) < distance.get(target, math.inf):
                distance[target] = length + math.hypot(dr, dc)
                heapq.heappush(queue, (distance[target], target))
    result = np.full(blocked.shape, np.inf)
    for cell, length in distance.items():
        result[cell] = length
    return result


def _expected(blocked, start, goal, limit, side):
    """The definition, cell by cell."""
    blocked = blocked.copy()
    blocked[start] = blocked[goal] = False
    from_start, from_goal = _dijkstra(blocked, start), _dijkstra(blocked, goal)
    if math.isinf(from_start[goal]):
        return None
    squares = np.full((3, *(-(-size // side) for size in blocked.shape)), np.inf)
    for row, col in np.ndindex(blocked.shape):
        near, far = from_start[row, col], from_goal[row, col]
        detour = max(near + far - from_start[goal], 0.0)
        if detour <= limit + 1e-9:
            square = squares[:, row // side, col // side]
            np.minimum(square, (near, far, detour), out=square)
    return squares


def _assert_equal(actual, expected):
    if expected is None:
        assert actual is None
    else:
        assert actual.dtype == np.float32
        np.testing.assert_allclose(actual, expected, rtol=1e-6, atol=1e-5)


@given(_grids())
def test_numpy_follows_the_definition(case):
    _assert_equal(relaxed_detours(*case), _expected(*case))


@settings(max_examples=300)
@given(_grids())
def test_the_compiled_search_follows_the_definition(case):
    pytest.importorskip("planformer._core", reason="the planning core is not built")
    _assert_equal(detours(*case), _expected(*case))


@pytest.mark.parametrize("make", [generate_forest, generate_maze])
@pytest.mark.parametrize("limit", [5.0, 60.0])
def test_compiled_equals_numpy_on_whole_maps(make, limit):
    pytest.importorskip("planformer._core", reason="the planning core is not built")
    blocked = make(3, width=12.0, height=10.0).blocked(0.1)
    rng = np.random.default_rng(0)
    for start, goal in rng.choice(np.argwhere(~blocked), (5, 2)):
        case = blocked, tuple(map(int, start)), tuple(map(int, goal)), limit, 5
        _assert_equal(detours(*case), relaxed_detours(*case))


@pytest.mark.parametrize("cell", [(-1, 0), (0, -1), (2, 0), (0, 3)])
def test_a_cell_outside_the_grid_is_refused(cell):
    pytest.importorskip("planformer._core", reason="the planning core is not built")
    for ends in ((cell, (0, 0)), ((0, 0), cell)):
        with pytest.raises(IndexError):
            detours(np.zeros((2, 3), bool), *ends, 1.0, 1)


def test_a_way_too_long_to_be_counted_is_none():
    blocked = np.zeros((2999, 3000), bool)
    blocked[1::4, :-1] = blocked[3::4, 1:] = True  # a serpentine of 4.5 million cells
    assert detours(blocked, (0, 0), (2998, 0), 10.0, 60) is None
    assert detours(blocked, (0, 0), (2000, 0), 10.0, 60) is not None
