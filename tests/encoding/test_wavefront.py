from __future__ import annotations

import heapq
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from planformer.encoding.wavefront import relaxed_wavefront, wavefront


@st.composite
def _grids(draw):
    shape = draw(st.tuples(st.integers(1, 12), st.integers(1, 12)))
    blocked = draw(arrays(bool, shape, elements=st.sampled_from([False, False, True])))
    return blocked, tuple(draw(st.integers(0, size - 1)) for size in shape)


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


@given(_grids())
def test_numpy_equals_dijkstra(case):
    assert np.allclose(relaxed_wavefront(*case), _dijkstra(*case), rtol=1e-6)


@given(_grids())
def test_compiled_equals_numpy(case):
    pytest.importorskip("planformer._core", reason="the planning core is not built")
    assert np.allclose(wavefront(*case), relaxed_wavefront(*case), rtol=1e-6)
