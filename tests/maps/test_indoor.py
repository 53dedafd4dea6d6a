from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.ndimage import binary_dilation, label

from planformer.errors import InvalidParameter
from planformer.maps import generate_indoor
from planformer.maps.floorplan import WALL, generate_floor_plan


def largest_share(mask: np.ndarray) -> float:
    sizes = np.bincount(label(mask)[0].ravel())[1:]
    return sizes.max() / sizes.sum()


def test_the_same_seed_gives_the_same_map():
    assert generate_indoor(3) == generate_indoor(3)
    assert generate_indoor(3) == generate_indoor(np.random.default_rng(3))
    assert generate_indoor(3) != generate_indoor(4)


@pytest.mark.parametrize(
    ("size", "seeds"),
    [
        ({}, range(30)),
        ({"resolution": 0.1}, range(20)),
        ({"width": 6.0, "height": 6.0}, range(20)),
        ({"width": 40.0, "height": 8.0, "resolution": 0.03}, range(5)),
        ({"width": 80.0, "height": 80.0}, range(1)),
    ],
    ids=["default", "coarse", "smallest", "long", "large"],
)
def test_a_robot_reaches_nearly_all_free_space(size, seeds):
    for seed in seeds:
        grid = generate_indoor(seed, **size)
        reachable = ~grid.blocked(0.2)
        assert largest_share(reachable) > 0.95, f"seed {seed}"
        assert 0.2 < reachable.mean() < 0.9, f"seed {seed}"


def test_the_map_looks_scanned():
    for seed in range(10):
        grid = generate_indoor(seed)
        seen = grid.occupied & ~grid.unknown
        assert grid.occupied[grid.unknown].all()
        assert 0.02 < seen.mean() < 0.2
        assert 0.1 < grid.unknown.mean() < 0.6
        # Surfaces are thin: what was seen lies within two cells of free space.
        near = binary_dilation(grid.free, np.ones((3, 3)), iterations=2)
        assert near[seen].all()
        for side in (grid.unknown[0], grid.unknown[-1], grid.unknown[:, 0], grid.unknown[:, -1]):
            assert side.mean() > 0.8


def test_size_and_resolution():
    grid = generate_indoor(0, width=9.0, height=7.0, resolution=0.02)
    assert grid.shape == (350, 450)
    assert grid.resolution == 0.02


@pytest.mark.parametrize("size", [(20.0, 20.0), (50.0, 9.0), (9.0, 50.0), (5.0, 5.0)])
def test_floor_plans_tile_the_building_and_are_connected(size):
    for seed in range(20):
        plan = generate_floor_plan(np.random.default_rng(seed), *size)
        rects = [room.rect for room in plan.rooms]
        assert sum(rect.area for rect in rects) == pytest.approx(size[0] * size[1])
        assert not any(a.overlaps(b) for i, a in enumerate(rects) for b in rects[:i])
        assert all(min(rect.width, rect.height) > 1.5 for rect in rects)
        reached, frontier = {0}, [0]
        while frontier:
            room = frontier.pop()
            for door in plan.doors:
                if room in door.rooms:
                    new = set(door.rooms) - reached
                    reached |= new
                    frontier += new
        assert reached == set(range(len(rects)))


def test_doors_are_as_wide_as_doors():
    plan = generate_floor_plan(np.random.default_rng(0), 30.0, 30.0)
    for door in plan.doors:
        along = door.opening.height if door.is_vertical else door.opening.width
        across = door.opening.width if door.is_vertical else door.opening.height
        assert across >= WALL
        assert along >= 0.9
        assert not door.has_leaf or along <= 1.0 + 1e-9


@pytest.mark.parametrize(
    "setting",
    [
        {"width": 5.9},
        {"height": 0.0},
        {"width": math.nan},
        {"resolution": 0.11},
        {"resolution": -0.05},
        {"resolution": 1e-5},
    ],
)
def test_bad_settings(setting):
    with pytest.raises(InvalidParameter):
        generate_indoor(0, **setting)
