from __future__ import annotations

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

pytest.importorskip("torch", reason="training needs PyTorch")

from planformer.training.connectivity import connected


@given(
    st.tuples(st.integers(1, 25), st.integers(1, 25)).flatmap(lambda shape: arrays(bool, shape)),
    st.randoms(use_true_random=False),
)
def test_equals_opencv(free, random):
    _, labels = cv2.connectedComponents(free.astype(np.uint8), connectivity=4)
    first, second = (tuple(random.randrange(size) for size in free.shape) for _ in range(2))
    expected = labels[first] == labels[second] != 0
    assert connected(free, first, second) == expected


def test_follows_a_long_spiral():
    size = 101
    free = np.zeros((size, size), bool)
    row = col = 0
    free[0, 0] = True
    for turn, length in enumerate([size - 1, *np.repeat(np.arange(size - 1, 1, -2), 2)]):
        dr, dc = ((0, 1), (1, 0), (0, -1), (-1, 0))[turn % 4]
        for _ in range(length):
            row, col = row + dr, col + dc
            free[row, col] = True
    assert connected(free, (0, 0), (row, col))
    free[50, size - 1] = False
    assert not connected(free, (0, 0), (row, col))
