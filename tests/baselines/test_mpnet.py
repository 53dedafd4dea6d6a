from __future__ import annotations

import hashlib
import json
import math
import threading

import numpy as np
import pytest

pytest.importorskip("torch", reason="the test's network is trained with PyTorch")
pytest.importorskip("onnx", reason="the test's network is exported with onnx")

import planformer as pf
from planformer.baselines import MPNetPlanner, load_mpnet
from planformer.errors import InvalidParameter, InvalidWeights, UnknownPlanner, WeightsMismatch
from planformer.export.mpnet import export_mpnet
from planformer.guidance.weights import weights_path
from planformer.planning import PlanStatus, Problem, SearchLimits
from planformer.training.mpnet import train_mpnet
from training.doors import DoorPaths, config, door_map

POINT = pf.PointRobot(0.0)


@pytest.fixture(scope="module")
def weights(tmp_path_factory):
    """A network that knows the door, trained for some seconds."""
    folder = tmp_path_factory.mktemp("mpnet")
    settings = config(steps=500, augment=False, validate_every=500)
    trained = train_mpnet(settings, DoorPaths(200), folder, validation=DoorPaths(10, seed=1))
    return export_mpnet(trained.checkpoint, folder / "mpnet.onnx").weights


@pytest.fixture(scope="module")
def network(weights):
    return load_mpnet(weights)


def door_problem(seed, *, origin=(0.0, 0.0, 0.0)):
    grid = pf.OccupancyGrid(door_map(), 0.05, origin=origin)
    path = DoorPaths(seed + 1, seed=5)[seed].path
    start, goal = grid.frame.to_world(path[[0, -1]])
    return Problem(grid, POINT, tuple(start), tuple(goal))


def forest_problem(seed, size=12.0):
    grid = pf.generate_forest(seed, width=size, height=size)
    robot = pf.PointRobot(0.1)
    start, goal = (grid.nearest_free(xy, 0.1) for xy in ((1.0, 1.0), (size - 1, size - 1)))
    return Problem(grid, robot, start, goal)


def assert_answers(result, problem):
    assert result.solved
    assert result.path.dtype == np.float64
    np.testing.assert_array_equal(result.path[[0, -1]], [problem.start, problem.goal])
    assert pf.path_is_valid(problem.grid, problem.robot, result.path)
    assert result.length == pytest.approx(np.hypot(*np.diff(result.path, axis=0).T).sum())


def test_the_network_alone_finds_the_door(network):
    planner = MPNetPlanner(network, repair_seconds=0.0)
    for seed in range(10):
        problem = door_problem(seed, origin=(-3.0, 2.0, 0.7))
        result = planner.search(problem, seed=seed, limits=SearchLimits(None))
        assert_answers(result, problem)
        assert result.status is PlanStatus.FINISHED
        assert result.vertices >= 1
        assert result.length < 20.0


@pytest.mark.parametrize("seed", range(4))
def test_repairs_find_paths_where_the_network_knows_nothing(network, seed):
    problem = forest_problem(seed, size=9.0 + seed)
    result = MPNetPlanner(network).search(problem, seed=1, limits=SearchLimits(60.0))
    assert_answers(result, problem)


def test_the_same_seed_gives_the_same_result(network):
    planner, problem = MPNetPlanner(network, steps=3, replans=2), forest_problem(5)
    first, second, other = (
        planner.search(problem, seed=seed, limits=SearchLimits(60.0)) for seed in (3, 3, 4)
    )
    np.testing.assert_array_equal(first.path, second.path)
    assert (first.vertices, first.status) == (second.vertices, second.status)
    assert first.vertices != other.vertices or not np.array_equal(first.path, other.path)


def test_a_clear_view_needs_no_network(network):
    grid = pf.OccupancyGrid(np.zeros((40, 40), bool), 0.05)
    for goal in ((1.9, 1.5), (0.1, 0.2)):
        problem = Problem(grid, POINT, (0.1, 0.2), goal)
        result = MPNetPlanner(network).search(problem, seed=0)
        np.testing.assert_array_equal(result.path, [problem.start, goal])
        assert (result.vertices, result.status) == (0, PlanStatus.FINISHED)


def test_a_target_length_is_reached_or_the_best_path_returned(network):
    planner, problem = MPNetPlanner(network, restarts=20), door_problem(2)
    limits = SearchLimits(60.0)
    first = planner.search(problem, seed=1, limits=limits)
    hopeless = planner.search(problem, seed=1, limits=SearchLimits(60.0, target_length=0.1))
    assert_answers(hopeless, problem)
    assert hopeless.status is PlanStatus.FINISHED
    assert hopeless.length <= first.length
    limits = SearchLimits(60.0, target_length=hopeless.length)
    reached = planner.search(problem, seed=1, limits=limits)
    assert reached.status is PlanStatus.TARGET_REACHED
    assert reached.length <= hopeless.length


@pytest.mark.parametrize("repair_seconds", [0.0, 5.0])
@pytest.mark.parametrize("seconds", [1e-9, 0.01])
def test_a_deadline_ends_the_search(network, seconds, repair_seconds):
    planner = MPNetPlanner(network, repair_seconds=repair_seconds)
    limits = SearchLimits(seconds, target_length=0.1)
    result = planner.search(forest_problem(1), seed=0, limits=limits)
    assert result.status is PlanStatus.TIME_LIMIT
    assert result.solved == math.isfinite(result.length) == (len(result.path) > 0)


def test_a_number_of_vertices_ends_the_search(network):
    limits = SearchLimits(None, target_length=0.1, max_vertices=7)
    result = MPNetPlanner(network).search(forest_problem(1), seed=0, limits=limits)
    assert result.status is PlanStatus.VERTEX_LIMIT


def test_a_cancelled_search_ends(network):
    planner, cancel = MPNetPlanner(network, restarts=10**6), pf.CancelToken()
    limits = SearchLimits(None, target_length=0.1)
    timer = threading.Timer(0.1, cancel.cancel)
    timer.start()
    result = planner.search(forest_problem(1), seed=0, limits=limits, cancel=cancel)
    timer.join()
    assert result.status is PlanStatus.CANCELLED


def test_separated_rooms_are_unreachable(network):
    occupied = door_map()
    occupied[:, 57:63] = True
    problem = Problem(pf.OccupancyGrid(occupied, 0.05), POINT, (1.0, 1.0), (5.0, 1.0))
    result = MPNetPlanner(network).search(problem)
    assert result.status is PlanStatus.UNREACHABLE
    assert not result.solved
    assert result.path.shape == (0, 2)


def test_a_car_is_refused(network):
    grid = pf.OccupancyGrid(np.zeros((40, 40), bool), 0.05)
    problem = Problem(grid, pf.DubinsCar(0.1, 0.4), (0.5, 0.5, 0.0), (1.5, 1.5, 0.0))
    with pytest.raises(UnknownPlanner, match="PointRobot"):
        MPNetPlanner(network).search(problem)


@pytest.mark.parametrize(
    "settings",
    [{"steps": 0}, {"steps": 2.5}, {"replans": -1}, {"restarts": 0}, {"repair_seconds": math.nan}],
)
def test_impossible_settings(network, settings):
    with pytest.raises(InvalidParameter, match=next(iter(settings))):
        MPNetPlanner(network, **settings)


@pytest.mark.parametrize("seed", [-1, 2**32, 0.5])
def test_impossible_seeds(network, seed):
    with pytest.raises(InvalidParameter, match="seed"):
        MPNetPlanner(network).search(door_problem(0), seed=seed)


@pytest.fixture
def copied(weights, tmp_path):
    """Write weights and card, changed, with a sum that fits."""

    def copy(content=None, **changes):
        content = weights.read_bytes() if content is None else content
        card = json.loads(weights.with_suffix(".json").read_text())
        card["sha256"] = hashlib.sha256(content).hexdigest()
        path = tmp_path / "copy.onnx"
        path.write_bytes(content)
        path.with_suffix(".json").write_text(json.dumps({**card, **changes}))
        return path

    return copy


def test_bad_files_are_refused(copied, tmp_path):
    with pytest.raises(InvalidWeights, match="missing"):
        load_mpnet(tmp_path / "missing.onnx")
    with pytest.raises(InvalidWeights, match="ONNX Runtime"):
        load_mpnet(copied(b"no network"))
    with pytest.raises(InvalidWeights, match="scale"):
        load_mpnet(copied(scale={"resolution": -1}))
    with pytest.raises(WeightsMismatch, match="sha256"):
        load_mpnet(copied(sha256="0"))
    with pytest.raises(WeightsMismatch, match="are not MPNet's"):
        load_mpnet(weights_path("mpt"))
