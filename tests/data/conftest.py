from __future__ import annotations

import shutil

import numpy as np
import pytest

from planformer.data.generate import generate_dataset
from planformer.maps import OccupancyGrid, generate_indoor, save_map

SMALL = {
    "maps": 3,
    "paths_per_map": 4,
    "seed": 5,
    "width": 12.0,
    "height": 9.0,
    "maps_per_shard": 2,
    "show_progress": False,
}
CAR = {
    **SMALL,
    "kinds": ("forest",),
    "robot": "dubins",
    "paths_per_map": 2,
    "max_distance": 8.0,
    "expert": "hybrid-astar",
}


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


@pytest.fixture
def car_settings():
    """Settings of a small data set for a car: two shards."""
    return dict(CAR)


@pytest.fixture(scope="session")
def car_dataset(tmp_path_factory):
    """A data set for a car; read only."""
    folder = tmp_path_factory.mktemp("data") / "car"
    generate_dataset(folder, workers=1, **CAR)
    return folder


@pytest.fixture
def own_maps(tmp_path):
    """A folder of maps of four formats, sizes and resolutions, and what is none."""
    folder = tmp_path / "own"
    rooms = np.zeros((60, 90), bool)
    rooms[:40, 45] = True
    (folder / "floors").mkdir(parents=True)
    office = generate_indoor(1, width=10.0, height=8.0, resolution=0.1)
    save_map(OccupancyGrid(office.occupied, 0.1, origin=(-3.0, 4.0, 0.5)), folder / "office.yaml")
    save_map(OccupancyGrid(rooms, 0.05), folder / "floors" / "rooms.npy")
    save_map(OccupancyGrid(rooms.T, 0.05), folder / "picture.png")
    cells = "\n".join(["." * 70] * 66)
    text = f"type octile\nheight 66\nwidth 70\nmap\n{cells}\n"
    (folder / "bench.map").write_text(text, encoding="ascii")
    (folder / "notes.txt").write_text("not a map", encoding="ascii")
    (folder / ".cache").mkdir()
    (folder / ".cache" / "old.png").write_bytes(b"not a picture")
    return folder
