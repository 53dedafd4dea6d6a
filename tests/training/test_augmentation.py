from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

pytest.importorskip("torch", reason="training needs PyTorch")

from planformer.training.augmentation import (
    Example,
    augment,
    mirrored,
    reversed_example,
    transposed,
)

TRANSFORMS = [mirrored, transposed, reversed_example]


def _example(seed):
    """A path of cell centres that are blocked, so that map and points can be compared."""
    rng = np.random.default_rng(seed)
    blocked = np.zeros((30, 50), bool)
    cells = np.stack([rng.integers(30, size=5), rng.integers(50, size=5)], axis=1)
    blocked[tuple(cells.T)] = True
    xy = (cells[:, ::-1] + 0.5) * 0.1
    path = np.column_stack([xy, rng.uniform(-3, 3, 5)])
    return Example(blocked, 0.1, path[0], path[-1], path)


def _cells(example):
    return np.floor(example.path[:, 1::-1] / example.resolution).astype(int)


@given(st.integers(0, 1000), st.integers(0, 1000))
def test_map_and_path_move_together(seed, augmentation):
    original = _example(seed)
    example = augment(original, np.random.default_rng(augmentation))
    assert example.blocked[tuple(_cells(example).T)].all()
    assert example.blocked.sum() == original.blocked.sum()
    assert np.array_equal(example.path[0], example.start)
    assert np.array_equal(example.path[-1], example.goal)


@given(st.integers(0, 1000), st.sampled_from(TRANSFORMS))
def test_twice_is_as_before(seed, transform):
    original = _example(seed)
    twice = transform(transform(original))
    assert np.array_equal(twice.blocked, original.blocked)
    for ours, theirs in ((twice.path, original.path), (twice.start, original.start)):
        assert np.allclose(ours[..., :2], theirs[..., :2])
        assert np.allclose(np.exp(1j * ours[..., 2]), np.exp(1j * theirs[..., 2]))


@pytest.mark.parametrize("transform", TRANSFORMS)
def test_yaw_stays_along_the_direction_of_travel(transform):
    yaw = 0.7
    path = np.array([[1.0, 1.0, yaw], [1 + np.cos(yaw), 1 + np.sin(yaw), yaw]])
    moved = transform(Example(np.zeros((30, 50), bool), 0.1, path[0], path[1], path))
    direction = (moved.path[1] - moved.path[0])[:2]
    for state in (moved.start, moved.goal):
        assert np.allclose(direction, [np.cos(state[2]), np.sin(state[2])])


def test_every_symmetry_occurs():
    original = _example(0)
    seen = {augment(original, np.random.default_rng(i)).path.tobytes() for i in range(200)}
    assert len(seen) == 16
