"""Grid search of the compiled core against exhaustive references."""

from __future__ import annotations

import itertools
import math
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from scipy import ndimage
from scipy.sparse import coo_array
from scipy.sparse.csgraph import dijkstra

from planformer import _core
from planformer.geometry import polyline_length
from planformer.maps.forest import generate_forest
from planformer.maps.maze import generate_maze

# Eighths of a cell off its centre: exact in floating point and never on a grid line.
INSIDE_A_CELL = st.sampled_from([0.125, 0.375, 0.5, 0.625, 0.875])


@st.composite
def problems(draw):
    """A grid with cells of 1 m, mostly free, and two points on it."""
    shape = draw(st.tuples(st.integers(1, 12), st.integers(1, 12)))
    levels = draw(hnp.arrays(np.uint8, shape, elements=st.integers(0, 9)))
    blocked = levels < draw(st.integers(0, 6))
    start, goal = (
        [draw(st.integers(0, n - 1)) + draw(INSIDE_A_CELL) for n in shape[::-1]] for _ in range(2)
    )
    return blocked, np.array(start), np.array(goal)


def touches(a, b, blocked):
    """(N,) whether the closed segments a -> b, each (N, 2), touch a blocked closed cell.

    Separating axes, exact for coordinates in eighths: a segment misses a square when their
    bounding boxes are apart or the square is strictly on one side of the segment's line.
    """
    a, b = np.asarray(a)[:, None], np.asarray(b)[:, None]
    low = np.argwhere(blocked)[None, :, ::-1].astype(float)
    apart = (np.maximum(a, b) < low) | (np.minimum(a, b) > low + 1)
    corners = low[..., None, :] + [(0, 0), (0, 1), (1, 0), (1, 1)]
    along, to_corner = (b - a)[..., None, :], corners - a[..., None, :]
    side = along[..., 0] * to_corner[..., 1] - along[..., 1] * to_corner[..., 0]
    one_sided = (side > 0).all(-1) | (side < 0).all(-1)
    return (~(apart.any(-1) | one_sided)).any(-1)


def any_angle_length(blocked, start, goal, bound):
    """Shortest path over the visibility graph of free cell centres, start and goal.

    Only points on ways no longer than `bound` count; infinite where it is longer.
    """
    points = np.argwhere(~blocked)[:, ::-1] + 0.5
    over = sum(np.hypot(*(points - end).T) for end in (start, goal))
    points = np.vstack([start, goal, points[over <= bound]])
    i, j = np.triu_indices(len(points), 1)
    seen = ~touches(points[i], points[j], blocked)
    i, j = i[seen], j[seen]
    # A zero would count as no edge.
    lengths = np.maximum(np.hypot(*(points[i] - points[j]).T), 1e-12)
    graph = coo_array((lengths, (i, j)), shape=(len(points),) * 2)
    return dijkstra(graph, directed=False, indices=0)[1]


def grid_distances(blocked, source):
    """(h, w) distances over single steps by scipy's Dijkstra; nothing enters a blocked cell."""
    height, width = blocked.shape
    number = np.arange(blocked.size).reshape(blocked.shape)
    edges = []
    for (r, c), (dr, dc) in itertools.product(
        np.ndindex(blocked.shape), itertools.product((-1, 0, 1), repeat=2)
    ):
        if (dr, dc) == (0, 0) or not (0 <= r + dr < height and 0 <= c + dc < width):
            continue
        leaves = not blocked[r, c] or (r, c) == source
        if leaves and not (blocked[r + dr, c + dc] or blocked[r + dr, c] or blocked[r, c + dc]):
            edges.append((number[r, c], number[r + dr, c + dc], math.hypot(dr, dc)))
        elif leaves and 0 in (dr, dc) and not blocked[r + dr, c + dc]:
            edges.append((number[r, c], number[r + dr, c + dc], 1.0))
    i, j, cost = np.array(edges).reshape(-1, 3).T
    graph = coo_array((cost, (i.astype(int), j.astype(int))), shape=(blocked.size,) * 2)
    return dijkstra(graph, indices=number[source]).reshape(blocked.shape)


def cell_of(point):
    return math.floor(point[1]), math.floor(point[0])


@pytest.mark.parametrize("find", [_core.lazy_theta, _core.astar])
@settings(max_examples=300)
@given(problem=problems())
def test_a_path_is_found_exactly_where_one_exists_and_is_valid(find, problem):
    blocked, start, goal = problem
    path = find(blocked, 1.0, start, goal)
    labels, _ = ndimage.label(~blocked)
    reachable = labels[cell_of(start)] == labels[cell_of(goal)] != 0
    assert path.dtype == np.float64
    assert path.shape[1] == 2
    assert (len(path) >= 2) == reachable
    if reachable:
        np.testing.assert_array_equal(path[[0, -1]], [start, goal])
        assert not touches(path[:-1], path[1:], blocked).any()


@pytest.mark.parametrize("find", [_core.lazy_theta, _core.astar])
@settings(max_examples=200)
@given(problem=problems())
def test_the_length_lies_between_any_angle_optimum_and_steps_over_cells(find, problem):
    blocked, start, goal = problem
    path = find(blocked, 1.0, start, goal)
    if len(path) == 0:
        return
    to_centres = sum(
        math.dist(point, np.array(cell_of(point))[::-1] + 0.5) for point in (start, goal)
    )
    over_cells = grid_distances(blocked, cell_of(start))[cell_of(goal)] + to_centres
    length = polyline_length(path)
    assert any_angle_length(blocked, start, goal, length + 1e-6) <= length + 1e-9
    assert length <= over_cells * (1 + 1e-6) + 1e-9


@pytest.mark.parametrize(("generate", "maps"), [(generate_forest, 24), (generate_maze, 6)])
def test_the_length_is_within_half_a_percent_of_the_any_angle_optimum(generate, maps):
    excess = []
    for seed in range(maps):
        blocked = generate(seed, width=5.1, height=5.1, resolution=0.2).occupied
        cells = np.random.default_rng(seed).choice(np.argwhere(~blocked), (2, 2))[..., ::-1]
        for start, goal in cells + np.array([0.375, 0.625]):
            path = _core.lazy_theta(blocked, 1.0, start, goal)
            if len(path) > 2:
                length = polyline_length(path)
                best = any_angle_length(blocked, start, goal, length + 1e-6)
                excess.append(length / best - 1.0)
    assert len(excess) >= 6
    assert np.mean(excess) <= 0.005
    assert max(excess) <= 0.03


@pytest.mark.parametrize("generate", [generate_forest, generate_maze])
def test_paths_on_maps_are_valid_and_cannot_be_shortcut(generate):
    grid = generate(3, width=8.0, height=8.0)
    blocked = grid.blocked(0.1)
    cells = np.argwhere(~blocked)
    ends = (cells[[0, -1]][:, ::-1] + 0.5) * grid.resolution
    path = _core.lazy_theta(blocked, grid.resolution, *ends) / grid.resolution
    assert len(path) > 2
    path = np.round(path * 8) / 8  # undoes the rounding of cells to metres and back
    assert not touches(path[:-1], path[1:], blocked).any()
    assert touches(path[:-2], path[2:], blocked).all()


@pytest.mark.parametrize("generate", [generate_forest, generate_maze])
def test_astar_is_not_much_longer_than_lazy_theta(generate):
    ratios = []
    for seed in range(10):
        blocked = generate(seed, width=8.0, height=8.0).blocked(0.1)
        cells = np.random.default_rng(seed).choice(np.argwhere(~blocked), 2)[:, ::-1]
        ends = (cells + 0.5) * 0.05
        paths = (find(blocked, 0.05, *ends) for find in (_core.astar, _core.lazy_theta))
        lengths = [polyline_length(path) for path in paths if len(path)]
        ratios += [lengths[0] / lengths[1]] if len(lengths) == 2 else []
    assert len(ratios) >= 5
    assert 1.0 <= max(ratios) < 1.1
    assert min(ratios) > 0.999


def test_start_equal_to_goal_gives_both():
    path = _core.lazy_theta(np.zeros((3, 3), bool), 0.5, np.array([0.7, 0.2]), np.array([0.7, 0.2]))
    np.testing.assert_array_equal(path, [[0.7, 0.2], [0.7, 0.2]])


def test_one_cell_holds_start_and_goal():
    start, goal = np.array([0.01, 0.02]), np.array([0.04, 0.03])
    np.testing.assert_array_equal(
        _core.lazy_theta(np.zeros((1, 1), bool), 0.05, start, goal), [start, goal]
    )
    assert _core.lazy_theta(np.ones((1, 1), bool), 0.05, start, goal).shape == (0, 2)


def test_nothing_passes_between_diagonal_obstacles():
    blocked = np.array([[False, True], [True, False]])
    path = _core.lazy_theta(blocked, 1.0, np.array([0.5, 0.5]), np.array([1.5, 1.5]))
    assert path.shape == (0, 2)


@pytest.mark.parametrize("bad", [(-0.1, 0.5), (0.5, 3.0), (1.5, 1.5), (np.nan, 0.5), (0.5, np.inf)])
def test_a_blocked_or_outside_end_is_unreachable(bad):
    blocked = np.zeros((3, 3), bool)
    blocked[1, 1] = True
    fine = np.array([0.5, 0.5])
    assert _core.lazy_theta(blocked, 1.0, np.array(bad), fine).shape == (0, 2)
    assert _core.lazy_theta(blocked, 1.0, fine, np.array(bad)).shape == (0, 2)


def test_other_array_types_and_layouts_give_the_same():
    blocked = generate_maze(1, width=6.0, height=6.0).blocked(0.1)
    ends = (np.argwhere(~blocked)[[0, -1]][:, ::-1] + 0.5) * 0.05
    expected = _core.lazy_theta(blocked, 0.05, *ends)
    for other in (blocked.astype(np.uint8) * 255, np.asfortranarray(blocked)):
        np.testing.assert_array_equal(_core.lazy_theta(other, 0.05, *ends), expected)


@pytest.mark.parametrize("resolution", [0.0, -1.0, math.nan])
def test_a_resolution_that_is_not_positive_is_refused(resolution):
    with pytest.raises(ValueError, match="resolution"):
        _core.lazy_theta(np.zeros((2, 2), bool), resolution, np.zeros(2), np.zeros(2))


def test_threads_do_not_disturb_each_other():
    blocked = generate_maze(2, width=12.0, height=12.0).blocked(0.1)
    cells = np.argwhere(~blocked)
    pairs = (np.random.default_rng(0).choice(cells, (24, 2))[..., ::-1] + 0.5) * 0.05
    alone = [_core.lazy_theta(blocked, 0.05, *pair) for pair in pairs]
    with ThreadPoolExecutor(4) as pool:
        together = list(pool.map(lambda pair: _core.lazy_theta(blocked, 0.05, *pair), pairs))
    for one, other in zip(alone, together, strict=True):
        np.testing.assert_array_equal(one, other)


@given(shape=st.tuples(st.integers(1, 12), st.integers(1, 12)), seed=st.integers(0, 2**32 - 1))
def test_widest_path_is_the_highest_level_that_connects(shape, seed):
    rng = np.random.default_rng(seed)
    blocked = rng.random(shape) < 0.2
    values = rng.choice([-1.0, 0.0, 0.1, 0.4, 0.5, 0.9], shape).astype(np.float32)
    start, goal = (tuple(int(rng.integers(n)) for n in shape) for _ in range(2))
    connecting = [
        level
        for level in np.unique(values[values >= 0])
        if _joined((values >= level) & ~blocked, start, goal)
    ]
    expected = max(connecting, default=None)
    assert _core.widest_path(blocked, values, start, goal) == expected


def _joined(free, start, goal):
    labels, _ = ndimage.label(free)
    return labels[start] != 0 and labels[start] == labels[goal]


def test_widest_path_refuses_cells_outside_and_other_shapes():
    blocked, values = np.zeros((3, 4), bool), np.zeros((3, 4), np.float32)
    with pytest.raises(IndexError):
        _core.widest_path(blocked, values, (0, 0), (3, 0))
    with pytest.raises(ValueError, match="same shape"):
        _core.widest_path(blocked, values[:2], (0, 0), (1, 0))
