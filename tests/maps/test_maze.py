from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.ndimage import label

from planformer.errors import InvalidParameter
from planformer.maps import generate_maze

PITCH = 0.375 + 1.2


def cells_of(width, height):
    """Centres of the maze cells, (rows, columns, 2), for a maze centred on the map."""
    n_rows, n_columns = (math.floor((size - 0.375) / PITCH + 1e-9) for size in (height, width))
    x = width / 2 + (np.arange(n_columns) - (n_columns - 1) / 2) * PITCH
    y = height / 2 + (np.arange(n_rows) - (n_rows - 1) / 2) * PITCH
    return np.stack(np.meshgrid(x, y), axis=-1)


def test_the_same_seed_gives_the_same_map():
    assert generate_maze(3) == generate_maze(3)
    assert generate_maze(3) == generate_maze(np.random.default_rng(3))
    assert generate_maze(3) != generate_maze(4)


@settings(max_examples=30)
@given(
    st.integers(0, 2**32),
    st.floats(1.95, 14.0),
    st.floats(1.95, 14.0),
    st.sampled_from([0.05, 0.1, 0.15, 0.3]),
)
def test_perfect_maze_of_any_size(seed, width, height, resolution):
    grid = generate_maze(seed, width=width, height=height, resolution=resolution)
    assert grid.shape == (round(height / resolution), round(width / resolution))
    # Connected, and with one passage less than cells: a tree.
    assert label(grid.free)[1] == 1
    centres = cells_of(width, height)

    def is_free(points):
        rows, columns = np.moveaxis(grid.to_rc(points), -1, 0)
        return grid.free[rows, columns]

    assert is_free(centres).all()
    right = is_free((centres[:, :-1] + centres[:, 1:]) / 2)
    above = is_free((centres[:-1] + centres[1:]) / 2)
    assert right.sum() + above.sum() == centres[..., 0].size - 1


def test_widths_are_those_of_the_paper():
    grid = generate_maze(0)
    assert grid.shape == (480, 480)
    centres = cells_of(24.0, 24.0)
    assert centres.shape == (15, 15, 2)
    for between in ((centres[:, :-1] + centres[:, 1:]) / 2, (centres[:-1] + centres[1:]) / 2):
        r, c = np.moveaxis(grid.to_rc(between), -1, 0)
        half_passages = grid.clearance[r, c][grid.free[r, c]]
        assert np.abs(half_passages - 0.6).max() < 0.06
    assert grid.occupied[:7].all()
    assert grid.occupied[:, -7:].all()


def test_mazes_differ_and_turn_in_all_directions():
    """Every wall between neighbouring cells is open in some mazes and shut in others."""
    mean = np.mean([generate_maze(s, width=6.0, height=6.0).free for s in range(60)], axis=0)
    grid = generate_maze(0, width=6.0, height=6.0)
    centres = cells_of(6.0, 6.0)
    for between in ((centres[:, :-1] + centres[:, 1:]) / 2, (centres[:-1] + centres[1:]) / 2):
        rc = grid.to_rc(between)
        share = mean[rc[..., 0], rc[..., 1]]
        assert (share > 0.3).all()
        assert (share < 0.95).all()


@pytest.mark.parametrize(
    "setting",
    [
        {"width": 1.9},
        {"height": 0.0},
        {"width": math.nan},
        {"resolution": 0.4},
        {"resolution": -0.05},
        {"resolution": 1e-5},
    ],
)
def test_bad_settings(setting):
    with pytest.raises(InvalidParameter):
        generate_maze(0, **setting)


@pytest.mark.parametrize("seed", [-1, 1.5, "a", None])
def test_bad_seeds(seed):
    with pytest.raises(InvalidParameter, match="seed"):
        generate_maze(seed)
