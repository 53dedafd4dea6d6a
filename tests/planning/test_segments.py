"""The core's motion check against exact arithmetic and against the independent path check."""

from __future__ import annotations

import itertools
import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from planformer import _core
from planformer.planning.validity import touched_cells_blocked

SIZE = 8
EIGHTHS = st.integers(-4, 8 * SIZE + 4).map(lambda k: k / 8)
ANY = st.floats(-0.5, SIZE + 0.5)


@st.composite
def grids(draw):
    """An 8 x 8 grid with a few blocked cells, more of them as they shrink."""
    cells = draw(st.sets(st.tuples(st.integers(0, SIZE - 1), st.integers(0, SIZE - 1)), max_size=8))
    blocked = np.zeros((SIZE, SIZE), bool)
    for cell in cells:
        blocked[cell] = True
    return blocked


def crossings(a, b):
    """Exact parameters in [0, 1] at which a coordinate that goes from a to b is whole."""
    if a == b:
        return []
    low, high = min(a, b), max(a, b)
    return [(Fraction(k) - a) / (b - a) for k in range(math.ceil(low), math.floor(high) + 1)]


def touched_cells(p, q):
    """The cells (row, col) that a segment touches, exactly; at a corner also the two beside it."""
    p, q = [Fraction(v) for v in p], [Fraction(v) for v in q]
    in_x, in_y = crossings(p[0], q[0]), crossings(p[1], q[1])
    cuts = sorted({Fraction(0), Fraction(1), *in_x, *in_y})
    middles = [(a + b) / 2 for a, b in itertools.pairwise(cuts)]
    points = {t: [a + t * (b - a) for a, b in zip(p, q, strict=True)] for t in cuts + middles}
    cells = {t: (math.floor(y), math.floor(x)) for t, (x, y) in points.items()}
    touched = set(cells.values())
    for t in set(in_x) & set(in_y) - {Fraction(0), Fraction(1)}:
        x, y = (int(v) for v in points[t])
        touched |= {(r, c) for r in (y - 1, y) for c in (x - 1, x)}
    return touched | corner_at_an_end(p, q, in_x, in_y, points, cells)


def corner_at_an_end(p, q, in_x, in_y, points, cells):
    """A segment that enters its end cell, or leaves its start cell, through the corner."""
    touched = set()
    for end in set(in_x) & set(in_y) & {Fraction(0), Fraction(1)}:
        inside = Fraction(1, 10**9) if end == 0 else 1 - Fraction(1, 10**9)
        near = [a + inside * (b - a) for a, b in zip(p, q, strict=True)]
        row, col = math.floor(near[1]), math.floor(near[0])
        if row != cells[end][0] and col != cells[end][1]:
            touched |= {(row, cells[end][1]), (cells[end][0], col)}
    return touched


def exactly_free(blocked, p, q):
    height, width = blocked.shape
    return all(
        0 <= row < height and 0 <= col < width and not blocked[row, col]
        for row, col in touched_cells(p, q)
    )


def is_free(blocked, p, q, resolution=1.0):
    return _core.segment_is_free(blocked, resolution, *p, *q)


def distance_to_lattice_point(p, q):
    """How close a segment comes to a corner of the grid, and its ends to grid lines."""
    corners = np.stack(np.meshgrid(*2 * [np.arange(-1.0, SIZE + 2)]), axis=-1).reshape(-1, 2)
    a, d = np.asarray(p), np.subtract(q, p)
    along = np.clip((corners - a) @ d / max(d @ d, 1e-30), 0, 1)
    gap = np.hypot(*(corners - (a + along[:, None] * d)).T).min()
    ends = np.abs(np.r_[p, q] - np.round(np.r_[p, q])).min()
    return min(gap, ends)


@settings(max_examples=400)
@given(grids(), *[EIGHTHS] * 4)
@example(np.eye(SIZE, dtype=bool)[::-1], 0.5, 0.5, 7.5, 7.5)  # between diagonal neighbours
@example(np.zeros((SIZE, SIZE), bool), 0.0, 3.0, 7.875, 3.0)  # on a grid line
@example(np.zeros((SIZE, SIZE), bool), 2.0, 2.0, 2.0, 2.0)
def test_equals_exact_arithmetic_on_lines_and_corners(blocked, x0, y0, x1, y1):
    assert is_free(blocked, (x0, y0), (x1, y1)) == exactly_free(blocked, (x0, y0), (x1, y1))


@settings(max_examples=400)
@given(grids(), *[ANY] * 4)
def test_equals_exact_arithmetic_and_the_path_check_in_general_position(blocked, x0, y0, x1, y1):
    p, q = (x0, y0), (x1, y1)
    if distance_to_lattice_point(p, q) < 1e-6:
        return
    assert is_free(blocked, p, q) == exactly_free(blocked, p, q)
    assert is_free(blocked, p, q) == (not touched_cells_blocked(blocked, np.array([p, q])))


@settings(max_examples=400)
@given(grids(), st.lists(st.tuples(EIGHTHS, EIGHTHS), min_size=2, max_size=6))
def test_the_path_check_accepts_what_the_core_accepts(blocked, points):
    free = all(is_free(blocked, p, q) for p, q in itertools.pairwise(points))
    if free:
        assert not touched_cells_blocked(blocked, np.array(points))


@settings(max_examples=200)
@given(grids(), st.lists(st.tuples(EIGHTHS, EIGHTHS), min_size=2, max_size=6))
def test_what_the_path_check_accepts_enters_no_blocked_cell(blocked, points):
    if touched_cells_blocked(blocked, np.array(points)):
        return
    for p, q in itertools.pairwise(points):
        for t in np.linspace(0, 1, 401):
            x, y = (1 - t) * np.array(p) + t * np.array(q)
            on_a_line = min(x % 1, 1 - x % 1, y % 1, 1 - y % 1) < 1e-6
            assert on_a_line or not blocked[int(y), int(x)]


@settings(max_examples=200)
@given(grids(), *[ANY] * 4)
def test_direction_does_not_matter(blocked, x0, y0, x1, y1):
    assert is_free(blocked, (x0, y0), (x1, y1)) == is_free(blocked, (x1, y1), (x0, y0))


def test_a_diagonal_gap_is_closed_to_both_checks():
    blocked = np.array([[False, True], [True, False]])
    for p, q in (((0.5, 0.5), (1.5, 1.5)), ((0.25, 0.25), (1.0, 1.0))):
        assert not is_free(blocked, p, q)
    assert touched_cells_blocked(blocked, np.array([(0.5, 0.5), (1.5, 1.5)]))
    assert touched_cells_blocked(blocked, np.array([(0.5, 0.5), (1.0, 1.0), (1.5, 1.5)]))
    other = blocked[:, ::-1].copy()
    assert not is_free(other, (0.5, 1.5), (1.5, 0.5))
    assert touched_cells_blocked(other, np.array([(0.5, 1.5), (1.5, 0.5)]))


@pytest.mark.parametrize("length", [1e-12, 1e-9, 1e-6])
def test_tiny_segments_across_a_line(length):
    blocked = np.array([[False, True, False]])
    assert is_free(blocked, (0.5, 0.5), (0.5 + length, 0.5))
    assert not is_free(blocked, (1 - length, 0.5), (1 + length, 0.5))
    assert not is_free(blocked, (2 + length, 0.5), (2 - length, 0.5))


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, 1e300, -1e300, 1e18, -1e-300])
@pytest.mark.parametrize("place", range(4))
def test_far_and_undefined_ends_are_blocked(value, place):
    ends = [2.5, 2.5, 2.5, 2.5]
    ends[place] = value
    assert not _core.segment_is_free(np.zeros((5, 5), bool), 1.0, *ends)


def test_the_borders_of_the_grid():
    blocked = np.zeros((2, 3), bool)
    assert is_free(blocked, (0.0, 0.0), (math.nextafter(3, 0), math.nextafter(2, 0)))
    assert not is_free(blocked, (0.0, 0.0), (3.0, 1.0))
    assert not is_free(blocked, (0.0, 0.0), (1.0, 2.0))


@pytest.mark.parametrize("resolution", [0.05, 0.1, 1 / 3, 7.0])
def test_long_diagonals_meet_every_corner_exactly(resolution):
    # 45 degrees through 4000 corners: at the last one too, the cells beside it must be seen.
    size = 4000
    for at in (1, size // 2, size - 1):
        blocked = np.zeros((size, size), bool)
        blocked[at, at - 1] = True  # touched at the corner (at, at) only
        ends = np.array([(0.5, 0.5), (size - 0.5, size - 0.5)]) * resolution
        assert not is_free(blocked, *ends, resolution)
        blocked[at, at - 1] = False
        assert is_free(blocked, *ends, resolution)


@settings(max_examples=60)
@given(st.integers(0, 2**32 - 1), st.sampled_from([0.05, 0.03, 1.0, 12.5]))
def test_long_segments_against_dense_samples(seed, resolution):
    rng = np.random.default_rng(seed)
    blocked = rng.random((70, 90)) < 0.02
    p, q = rng.uniform(0, (90, 70), (2, 2))
    points = p + np.linspace(0, 1, 20001)[:, None] * (q - p)
    hit = blocked[points[:, 1].astype(int), points[:, 0].astype(int)].any()
    free = is_free(blocked, p * resolution, q * resolution, resolution)
    assert not (hit and free)
    # Dense samples miss cells of which the segment cuts a tip shorter than their spacing.
    if not hit and not free:
        assert grazes_a_corner(blocked, p, q)


def grazes_a_corner(blocked, p, q):
    corners = np.argwhere(blocked)[:, ::-1][:, None] + np.array([(0, 0), (0, 1), (1, 0), (1, 1)])
    d = (q - p) / np.hypot(*(q - p))
    offset = corners.reshape(-1, 2) - p
    return np.abs(offset[:, 0] * d[1] - offset[:, 1] * d[0]).min() < 0.02
