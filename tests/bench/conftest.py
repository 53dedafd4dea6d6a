from __future__ import annotations

import json
import shutil

import numpy as np
import pytest

import planformer as pf
from planformer.bench.rows import GeneratedMaps, Row, Scene
from planformer.guidance.weights import weights_path


@pytest.fixture
def small_row():
    """A row of forests of 8 x 6 m: searches in them end within milliseconds."""
    return Row("small", (Scene("", GeneratedMaps("forest", 8.0, 6.0), pf.PointRobot()),))


@pytest.fixture
def car_row():
    """Forests of 8 x 8 m for a nimble car."""
    robot = pf.DubinsCar(radius=0.1, turning_radius=0.3)
    scene = Scene("", GeneratedMaps("forest", 8.0, 8.0), robot)
    return Row("car", (scene,), slack=1.05, seconds=2.0, max_distance=5.0)


@pytest.fixture
def broken_weights(tmp_path):
    """Writes weights that load but fail at every problem: the card misstates the stride."""
    shipped = weights_path("mpt")
    path = tmp_path / "broken.onnx"
    shutil.copy(shipped, path)
    card = json.loads(shipped.with_suffix(".json").read_text())
    card["scale"] |= {"stride": 10, "anchor_offset": 5}
    path.with_suffix(".json").write_text(json.dumps(card))
    return str(path)


@pytest.fixture
def heading_weights(tmp_path):
    """Weights whose card says that they need headings."""
    shipped = weights_path("mpt")
    path = tmp_path / "heading.onnx"
    shutil.copy(shipped, path)
    card = json.loads(shipped.with_suffix(".json").read_text())
    card["scale"]["headings"] = True
    path.with_suffix(".json").write_text(json.dumps(card))
    return str(path)


@pytest.fixture
def on_path():
    """Whether the middle of every segment of a path lies in a region."""

    def check(region, problem, path):
        points = np.concatenate((path[:, :2], 0.5 * (path[1:, :2] + path[:-1, :2])))
        rows, columns = problem.grid.to_rc(points).T
        return region.mask[rows, columns].all()

    return check
