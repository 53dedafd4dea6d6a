from __future__ import annotations

import shutil

import pytest

from planformer.data.generate import generate_dataset

SMALL = {"maps": 3, "paths_per_map": 4, "seed": 5, "maps_per_shard": 2, "show_progress": False}


@pytest.fixture(scope="session")
def _small_dataset(tmp_path_factory):
    folder = tmp_path_factory.mktemp("data") / "set"
    generate_dataset(folder, workers=1, **SMALL)
    return folder


@pytest.fixture
def small_settings():
    """Settings of a data set that takes a second to make: four shards of two kinds."""
    return dict(SMALL)


@pytest.fixture
def small_dataset(_small_dataset, tmp_path):
    """A copy of a small data set that a test may damage."""
    return shutil.copytree(_small_dataset, tmp_path / "set")
