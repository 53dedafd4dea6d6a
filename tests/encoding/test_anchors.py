from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from planformer.encoding import (
    NetworkScale,
    anchor_headings,
    anchor_labels,
    anchor_offsets,
    anchor_points,
    region_mask,
)
from planformer.errors import InvalidParameter

PAPER = NetworkScale(anchor_offset=4, query="square", query_stride=1)
COMPACT = NetworkScale()


def test_published_token_grid():
    anchors = anchor_points(480, 480, PAPER)
    assert anchors.shape == (24, 24, 2)
    assert anchors[0, 0] == pytest.approx([0.2, 0.2])
    assert anchors[3, 7] == pytest.approx([7.2, 3.2])  # (x, y) of (row, col)
    assert anchor_points(480, 480, COMPACT)[0, 0] == pytest.approx([0.5, 0.5])


@pytest.mark.parametrize("size", [0, -20, 481])
def test_refuses_sizes_between_tokens(size):
    with pytest.raises(InvalidParameter):
        anchor_points(size, 480, PAPER)


def test_labels_are_the_anchors_within_the_published_distance():
    anchors = anchor_points(480, 480, COMPACT)
    positive = anchor_labels(anchors, [[0.5, 10.0], [23.5, 10.0]])
    rows = np.unique(np.nonzero(positive)[0])
    assert rows.tolist() == [9, 10]  # at y = 9.5 and 10.5; 8.5 and 11.5 are 1.5 m away
    assert positive[9].all()


def test_headings_follow_the_path():
    anchors = anchor_points(480, 480, COMPACT)
    path = np.array([[2.5, 2.5], [12.5, 2.5], [12.5, 12.5]])
    headings = anchor_headings(anchors, path)
    assert headings[:, 2, 6] == pytest.approx([1, 0], abs=1e-6)
    assert headings[:, 8, 12] == pytest.approx([0, 1], abs=1e-6)
    corner = headings[:, 2, 12]
    assert corner == pytest.approx([0.5, 0.5], abs=0.1)  # half of it runs right, half of it up
    assert np.array_equal(headings[:, 20, 20], [0, 0])
    assert np.allclose(anchor_headings(anchors, path[::-1]), -headings, atol=1e-5)


def test_offsets_lead_to_the_path():
    anchors = anchor_points(480, 480, COMPACT)
    offsets = anchor_offsets(anchors, np.array([[2.5, 2.7, 1.0], [12.5, 2.7, 1.0]]))
    assert offsets[2, 6] == pytest.approx([0.0, 0.2])
    assert offsets[2, 1] == pytest.approx([1.0, 0.2])  # a metre before the path's start
    assert offsets[5, 6] == pytest.approx([0.0, -2.8])


def test_headings_exist_only_at_labels():
    anchors = anchor_points(480, 480, COMPACT)
    path = np.array([[1.0, 1.0], [14.0, 20.0], [22.0, 3.0]])
    has_heading = np.hypot(*anchor_headings(anchors, path)) > 0
    assert not (has_heading & ~anchor_labels(anchors, path)).any()


@given(arrays(bool, (6, 9)), st.sampled_from([PAPER, COMPACT]))
def test_mask_is_the_union_of_patches(selected, scale):
    mask = region_mask(selected, scale)
    expected = np.zeros((6 * scale.stride, 9 * scale.stride), bool)
    for row, col in np.argwhere(selected):
        first = [int(i * scale.stride + scale.anchor_offset - scale.patch // 2) for i in (row, col)]
        window = tuple(slice(max(f, 0), f + scale.patch) for f in first)
        expected[window] = True
    assert np.array_equal(mask, expected)
