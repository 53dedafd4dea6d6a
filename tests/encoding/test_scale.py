from __future__ import annotations

import json

import pytest

from planformer.encoding import NetworkScale, QueryKind
from planformer.errors import InvalidParameter


@pytest.mark.parametrize("query", list(QueryKind))
@pytest.mark.parametrize("headings", [False, True])
def test_survives_json(query, headings):
    stride = 1 if query is QueryKind.SQUARE else 5
    scale = NetworkScale(query=query, query_stride=stride, headings=headings)
    assert NetworkScale.from_dict(json.loads(json.dumps(scale.to_dict()))) == scale


@pytest.mark.parametrize(
    "values",
    [
        {"resolution": 0.0},
        {"resolution": float("nan")},
        {"stride": 0},
        {"patch": 0},
        {"anchor_offset": 20},
        {"anchor_offset": -1},
        {"query_stride": 3},
        {"query": "circle"},
        {"query": "square", "query_stride": 5},
        {"strides": 20},
    ],
)
def test_refuses(values):
    with pytest.raises(InvalidParameter):
        NetworkScale.from_dict(values)


@pytest.mark.parametrize(("pixels", "padded"), [(1, 20), (20, 20), (21, 40), (480, 480)])
def test_pads_to_whole_tokens(pixels, padded):
    assert NetworkScale().padded(pixels) == padded
