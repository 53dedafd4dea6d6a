from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from planformer.encoding import NetworkScale, QueryKind, encode_query
from planformer.encoding import wavefront as wavefront_module
from planformer.errors import InvalidParameter

FREE = np.zeros((480, 480), np.uint8)
START, GOAL = (3.0, 6.0, 0.5), (20.0, 15.0, -1.0)


def _scale(kind, headings=False):
    stride = 1 if kind is QueryKind.SQUARE else 5
    return NetworkScale(query=kind, query_stride=stride, headings=headings)


def test_published_square_query():
    query = encode_query(FREE, START, GOAL, _scale(QueryKind.SQUARE))
    assert query.shape == (1, 480, 480)
    assert query.dtype == np.float32
    assert (query == -1).sum() == (query == 1).sum() == 32 * 32
    assert (query[0, 104:136, 44:76] == -1).all()  # centred on (row, col) = (120, 60)
    assert (query[0, 284:316, 384:416] == 1).all()


def test_square_query_is_cut_at_the_border():
    query = encode_query(FREE, (0.0, 0.0), (23.9, 23.9), _scale(QueryKind.SQUARE))
    assert (query[0, :16, :16] == -1).all()
    assert (query == -1).sum() == 16 * 16


def test_square_query_holds_the_yaw():
    query = encode_query(FREE, START, GOAL, _scale(QueryKind.SQUARE, headings=True))
    assert query.shape == (3, 480, 480)
    assert query[1:, 120, 60] == pytest.approx([math.cos(0.5), math.sin(0.5)])
    assert query[1:, 300, 400] == pytest.approx([math.cos(-1.0), math.sin(-1.0)])


@pytest.mark.parametrize("kind", list(QueryKind))
@pytest.mark.parametrize("headings", [False, True])
def test_has_the_channels_that_the_scale_says(kind, headings):
    scale = _scale(kind, headings)
    side = 480 // scale.query_stride
    query = encode_query(FREE, START, GOAL, scale)
    assert query.shape == (scale.query_channels, side, side)
    assert np.isfinite(query).all()
    assert np.abs(query).max() <= 1


def test_markers_peak_at_start_and_goal():
    query = encode_query(FREE, START, GOAL, _scale(QueryKind.MARKERS))
    for channel, (x, y, _) in zip(query, (START, GOAL), strict=False):
        row, col = np.unravel_index(channel.argmax(), channel.shape)
        assert abs((row + 0.5) * 0.25 - y) <= 0.13
        assert abs((col + 0.5) * 0.25 - x) <= 0.13


def _wall(gap=None):
    """A wall from bottom to top between start and goal, with a gap at some rows."""
    pixels = FREE.copy()
    pixels[:, 200:205] = 1
    if gap:
        pixels[gap] = pixels[gap] * 0
    return pixels


def test_wavefront_shows_the_detour():
    pixels = _wall(gap=slice(440, 480))
    query = encode_query(pixels, START, GOAL, _scale(QueryKind.WAVEFRONT))
    on_way = query[4]
    assert on_way[int(22.0 / 0.25), 40] > 0.9  # at the lower end of the gap
    assert on_way[10, 90] < 0.1
    assert on_way[int(6.0 / 0.25), int(3.0 / 0.25)] == pytest.approx(1.0, abs=1e-5)


def test_wavefront_distances_are_symmetric():
    scale = _scale(QueryKind.WAVEFRONT)
    pixels = _wall(gap=slice(440, 480))
    there, back = (encode_query(pixels, *ends, scale) for ends in ((START, GOAL), (GOAL, START)))
    assert np.array_equal(there[[1, 0, 3, 2, 4, 5]], back)


def test_disconnected_start_and_goal_still_encode():
    query = encode_query(_wall(), START, GOAL, _scale(QueryKind.WAVEFRONT))
    assert np.isfinite(query).all()
    assert (query[2:4] == 1.0).all()  # infinitely far
    assert query[4].max() == 0.0


@given(st.integers(0, 5), st.integers(0, 5))
def test_translation_moves_the_wavefront_query(rows, cols):
    scale = _scale(QueryKind.WAVEFRONT)
    small = np.ones((240, 240), np.uint8)
    small[20:140, 20:140] = 0
    moved = np.roll(small, (20 * rows, 20 * cols), axis=(0, 1))
    shift = np.array([cols, rows], float)
    base = encode_query(small, (2.0, 2.0), (6.0, 5.0), scale)
    other = encode_query(moved, shift + 2.0, [6.0 + cols, 5.0 + rows], scale)
    rolled = np.roll(base, (4 * rows, 4 * cols), axis=(1, 2))
    assert np.allclose(rolled[[2, 3, 4, 5]], other[[2, 3, 4, 5]], atol=1e-6)


def test_without_the_compiled_core_the_query_is_the_same(monkeypatch):
    pytest.importorskip("planformer._core", reason="the planning core is not built")
    scale = _scale(QueryKind.WAVEFRONT)
    pixels = _wall(gap=slice(440, 480))
    compiled = encode_query(pixels, START, GOAL, scale)
    monkeypatch.setattr(wavefront_module, "_core", None)
    assert np.allclose(encode_query(pixels, START, GOAL, scale), compiled, atol=1e-6)


@pytest.mark.parametrize("start", [(1.0,), (1.0, 2.0, 3.0, 4.0), (math.nan, 1.0)])
def test_refuses_what_is_no_state(start):
    with pytest.raises(InvalidParameter):
        encode_query(FREE, start, GOAL, NetworkScale())


def test_refuses_a_missing_yaw():
    with pytest.raises(InvalidParameter, match="yaw"):
        encode_query(FREE, (1.0, 1.0), GOAL, NetworkScale(headings=True))


@pytest.mark.parametrize("thickness", [1, 2, 4])
@pytest.mark.parametrize("offset", range(5))
def test_no_wall_is_too_thin_to_stop_the_wavefront(offset, thickness):
    pixels = FREE.copy()
    pixels[:440, 200 + offset : 200 + offset + thickness] = 1
    query = encode_query(pixels, START, GOAL, _scale(QueryKind.WAVEFRONT))
    assert query[2, 60, 80] > math.tanh(2.9)  # 29.7 m round the wall's end, 19.2 m through it


@pytest.mark.parametrize("width", [1, 2, 5])
@pytest.mark.parametrize("offset", range(5))
def test_no_gap_is_too_narrow_for_the_wavefront(offset, width):
    gap = slice(300 + offset, 300 + offset + width)
    query = encode_query(_wall(gap=gap), START, GOAL, _scale(QueryKind.WAVEFRONT))
    assert query[2, 60, 80] < math.tanh(2.5)  # 22.7 m through the gap


def test_a_way_that_only_touches_at_corners_is_still_shown():
    pixels = _wall()
    steps = np.arange(300, 305)
    pixels[steps, steps - 100] = 0  # a diagonal of pixels through the wall
    query = encode_query(pixels, START, GOAL, _scale(QueryKind.WAVEFRONT))
    assert query[4].max() == pytest.approx(1.0)
    assert query[2, 60, 80] < math.tanh(2.5)


def test_a_wall_inside_a_query_pixel_is_no_way_through():
    """Start and goal are near each other's side of a thin wall, and far from each other."""
    pixels = _wall(gap=slice(440, 480)) * 0
    pixels[:440, 202] = 1
    query = encode_query(pixels, (9.9, 6.0), (10.4, 6.0), _scale(QueryKind.WAVEFRONT))
    on_way = query[4]
    assert on_way.max() == pytest.approx(1.0, abs=1e-3)
    along_the_wall = on_way[24:88, 38:43].max(axis=1)
    assert along_the_wall.min() > 0.9  # all the way up to the gap
