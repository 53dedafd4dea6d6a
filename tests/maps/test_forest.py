from __future__ import annotations

import math

import numpy as np
import pytest

from planformer.errors import InvalidParameter
from planformer.maps import generate_forest


def test_the_same_seed_gives_the_same_map():
    assert generate_forest(3) == generate_forest(3)
    assert generate_forest(3) == generate_forest(np.random.default_rng(3))
    assert generate_forest(3) != generate_forest(4)


def test_a_generator_moves_on():
    rng = np.random.default_rng(0)
    assert generate_forest(rng) != generate_forest(rng)


def test_size_and_border():
    grid = generate_forest(1, width=10.0, height=6.0, resolution=0.1)
    assert grid.shape == (60, 100)
    assert grid.resolution == 0.1
    border = np.ones(grid.shape, bool)
    border[1:-1, 1:-1] = False
    assert grid.occupied[border].all()
    assert not grid.unknown.any()


def test_density_is_that_of_the_paper():
    # n discs and squares of mean area a at density n / A leave exp(-n a / A) free, up to the edge.
    expected = 1 - math.exp(-(70 * math.pi * 0.75**2 + 30 * 1.5**2) / 576)
    shares = [generate_forest(seed, resolution=0.1).occupied.mean() for seed in range(40)]
    assert np.mean(shares) == pytest.approx(expected, abs=0.02)
    large = generate_forest(0, width=96.0, height=96.0, resolution=0.1)
    assert large.occupied.mean() == pytest.approx(expected, abs=0.02)


@pytest.mark.parametrize(
    ("kind", "area"), [("circles", math.pi * 0.75**2), ("squares", 1.5**2)], ids=str
)
def test_shape_of_a_single_obstacle(kind, area):
    counts = {"circles": 0, "squares": 0, kind: 1}
    for seed in range(20):
        occupied = generate_forest(seed, width=100.0, height=100.0, **counts).occupied[1:-1, 1:-1]
        assert occupied.sum() * 0.05**2 == pytest.approx(area, rel=0.02)


def test_the_map_is_the_same_at_every_resolution():
    fine = generate_forest(5, resolution=0.025)
    coarse = generate_forest(5, resolution=0.05)
    same = coarse.occupied == fine.occupied[::2, ::2]
    assert same[1:-1, 1:-1].mean() > 0.98


def test_no_obstacles():
    assert generate_forest(0, circles=0, squares=0).occupied[1:-1, 1:-1].sum() == 0


@pytest.mark.parametrize(
    "setting",
    [
        {"width": 0.9},
        {"height": -1.0},
        {"width": math.nan},
        {"height": math.inf},
        {"resolution": 0.0},
        {"resolution": 100.0},
        {"resolution": 1e-5},
        {"circles": -1},
        {"squares": -1},
    ],
)
def test_bad_settings(setting):
    with pytest.raises(InvalidParameter):
        generate_forest(0, **setting)


@pytest.mark.parametrize("side", [1e6, 1e200, 1e308])
def test_a_forest_of_too_many_obstacles_is_refused(side):
    with pytest.raises(InvalidParameter, match="too many"):
        generate_forest(0, width=side, height=side, resolution=side / 2)


@pytest.mark.parametrize("seed", [-1, 1.5, "a", None])
def test_bad_seeds(seed):
    with pytest.raises(InvalidParameter, match="seed"):
        generate_forest(seed)
