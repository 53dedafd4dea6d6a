from __future__ import annotations

import dataclasses
import itertools
import json
import math
import threading

import numpy as np
import pytest

pytest.importorskip("torch", reason="the test's network is trained with PyTorch")
pytest.importorskip("onnx", reason="the test's network is exported with onnx")

import planformer as pf
from planformer.baselines import NextPlanner, load_next
from planformer.baselines.next_map import free_parts, normalised, square_side
from planformer.baselines.next_tree import SearchTree
from planformer.baselines.next_visits import SmoothedVisits
from planformer.data.problems import random_problems
from planformer.errors import InvalidParameter, InvalidWeights, UnknownPlanner, WeightsMismatch
from planformer.export.next_ks import export_next
from planformer.planning import CancelToken, PlanStatus, Problem, SearchLimits
from training.doors import DoorPaths, door_map
from training.next_doors import train

POINT = pf.PointRobot(0.0)
UNTIMED = SearchLimits(None)


@pytest.fixture(scope="module")
def weights(tmp_path_factory):
    """A network that knows the door, trained for some seconds."""
    folder = tmp_path_factory.mktemp("next")
    trained = train(folder, steps=150, augment=False, imitation=0.9, validate_every=150)
    return export_next(trained.checkpoint, folder / "next.onnx").weights


@pytest.fixture(scope="module")
def network(weights):
    return load_next(weights)


def door_problem(seed, *, origin=(0.0, 0.0, 0.0)):
    grid = pf.OccupancyGrid(door_map(), 0.05, origin=origin)
    path = DoorPaths(seed + 1, seed=5)[seed].path
    start, goal = grid.frame.to_world(path[[0, -1]])
    return Problem(grid, POINT, tuple(start), tuple(goal))


def assert_answers(result, problem):
    assert result.solved
    assert result.path.dtype == np.float64
    np.testing.assert_array_equal(result.path[[0, -1]], [problem.start, problem.goal])
    assert pf.path_is_valid(problem.grid, problem.robot, result.path)
    assert result.length == pytest.approx(np.hypot(*np.diff(result.path, axis=0).T).sum())


def test_the_door_is_found(network):
    for seed in range(10):
        problem = door_problem(seed, origin=(-3.0, 2.0, 0.7))
        result = NextPlanner(network, samples=2000).search(problem, seed=seed, limits=UNTIMED)
        assert_answers(result, problem)
        assert result.status is PlanStatus.FINISHED


def test_the_network_saves_samples(network):
    """With RRT's samples alone the same search needs more states."""
    problems = [door_problem(seed) for seed in range(10)]
    led, blind = (
        [
            NextPlanner(network, 3000, exploration).search(p, seed=seed, limits=UNTIMED).vertices
            for seed, p in enumerate(problems)
        ]
        for exploration in (0.1, 1.0)
    )
    assert np.median(led) < np.median(blind)


@pytest.mark.parametrize("size", [(10.0, 10.0), (9.0, 5.0), (4.0, 11.0)])
def test_forests_of_any_size_are_crossed(network, size):
    grid = pf.generate_forest(4, width=size[0], height=size[1])
    rng = np.random.default_rng(0)
    problem = next(random_problems(grid, pf.PointRobot(0.1), min_distance=3.0, rng=rng))
    planner = NextPlanner(network, samples=2000, exploration=0.5)
    result = planner.search(problem, seed=0, limits=UNTIMED)
    assert_answers(result, problem)


def test_a_tree_is_consistent(network):
    limits = SearchLimits(None, target_length=0.1)
    problem = door_problem(1)
    result = NextPlanner(network, 400, 0.5).search(problem, seed=1, limits=limits, keep_tree=True)
    assert_answers(result, problem)
    vertices, edges = result.tree.vertices, result.tree.edges
    assert len(vertices) == result.vertices == len(edges) + 1
    np.testing.assert_array_equal(np.sort(edges[:, 1]), np.arange(1, len(vertices)))
    for edge in edges:
        assert pf.path_is_valid(problem.grid, POINT, vertices[edge])


def test_the_same_seed_gives_the_same_result(network):
    planner, problem = NextPlanner(network, samples=200), door_problem(5)
    first, second, other = (
        planner.search(problem, seed=seed, limits=UNTIMED) for seed in (3, 3, 4)
    )
    np.testing.assert_array_equal(first.path, second.path)
    assert (first.vertices, first.status) == (second.vertices, second.status)
    assert first.vertices != other.vertices or not np.array_equal(first.path, other.path)


def test_a_goal_within_a_step_needs_no_network():
    grid = pf.OccupancyGrid(np.zeros((40, 40), bool), 0.05)
    for goal in ((0.13, 0.2), (0.1, 0.2)):
        problem = Problem(grid, POINT, (0.1, 0.2), goal)
        result = NextPlanner(network=None).search(problem, seed=0)
        np.testing.assert_array_equal(result.path, [problem.start, goal])
        assert result.status is PlanStatus.FINISHED


def test_a_target_length_is_reached_or_the_best_path_returned(network):
    planner, problem = NextPlanner(network, 600, 0.5), door_problem(2)
    first = planner.search(problem, seed=1, limits=UNTIMED)
    hopeless = planner.search(problem, seed=1, limits=SearchLimits(None, target_length=0.1))
    assert_answers(hopeless, problem)
    assert hopeless.status is PlanStatus.FINISHED
    assert hopeless.length <= first.length
    limits = SearchLimits(None, target_length=hopeless.length + 1e-9)
    reached = planner.search(problem, seed=1, limits=limits)
    assert reached.status is PlanStatus.TARGET_REACHED
    assert reached.length <= limits.target_length


def test_limits_end_the_search(network):
    planner, problem = NextPlanner(network), door_problem(1)
    for limits, status in (
        (SearchLimits(1e-9, target_length=0.1), PlanStatus.TIME_LIMIT),
        (SearchLimits(None, target_length=0.1, max_vertices=3), PlanStatus.VERTEX_LIMIT),
    ):
        result = planner.search(problem, seed=0, limits=limits)
        assert result.status is status
        assert not result.solved
        assert (result.length, len(result.path)) == (math.inf, 0)


def test_too_few_samples_find_nothing(network):
    result = NextPlanner(network, samples=2).search(door_problem(0), seed=0)
    assert (result.solved, result.status) == (False, PlanStatus.FINISHED)


def test_a_search_can_be_cancelled(network):
    cancel = CancelToken()
    planner = NextPlanner(network, samples=10**6)
    threading.Timer(0.2, cancel.cancel).start()
    limits = SearchLimits(None, target_length=0.1)
    result = planner.search(door_problem(1), seed=0, limits=limits, cancel=cancel)
    assert result.status is PlanStatus.CANCELLED


def test_separated_ends_are_found_out():
    blocked = np.zeros((60, 60), bool)
    blocked[:, 30] = True
    problem = Problem(pf.OccupancyGrid(blocked, 0.05), POINT, (0.5, 0.5), (2.5, 0.5))
    result = NextPlanner(network=None).search(problem, seed=0)
    assert (result.solved, result.status) == (False, PlanStatus.UNREACHABLE)


def test_what_does_not_fit_is_refused(network):
    grid = pf.OccupancyGrid(np.zeros((60, 60), bool), 0.05)
    car = Problem(grid, pf.DubinsCar(), (1.0, 1.0, 0.0), (2.0, 2.0, 0.0))
    with pytest.raises(UnknownPlanner, match="DubinsCar"):
        NextPlanner(network).search(car)
    with pytest.raises(InvalidParameter, match="seed"):
        NextPlanner(network).search(door_problem(0), seed=-1)
    for name, value in (
        ("samples", 0),
        ("samples", 2.5),
        ("exploration", 1.5),
        ("uncertainty", math.nan),
    ):
        with pytest.raises(InvalidParameter, match=name):
            dataclasses.replace(NextPlanner(network), **{name: value})


@pytest.mark.parametrize("damage", ["missing", "truncated", "card", "side", "other"])
def test_bad_weights_are_refused(weights, tmp_path, damage):
    path = tmp_path / "next.onnx"
    content, card = weights.read_bytes(), json.loads(weights.with_suffix(".json").read_text())
    if damage == "truncated":
        content = content[:1000]
    if damage == "card":
        card = [card]
    if damage == "side":
        card["network"].pop("side")
    if damage != "missing":
        path.write_bytes(content)
    path.with_suffix(".json").write_text(json.dumps(card))
    if damage == "other":
        from planformer.guidance.weights import weights_path

        path, error = weights_path("mpt"), WeightsMismatch
    else:
        error = InvalidWeights
    with pytest.raises(error):
        load_next(path)


def test_a_network_that_fits_another_card_says_so(network):
    other = dataclasses.replace(network, idle={"free": network.idle["free"]})
    with pytest.raises(WeightsMismatch, match="card"):
        NextPlanner(other).search(door_problem(0), seed=0)


def test_rewiring_keeps_costs_and_shortens_ways():
    rng = np.random.default_rng(0)
    tree = SearchTree(np.zeros(2), 400, 0.3, lambda a, b: max(a[0], b[0]) < 0.9)
    lengths = []
    for _ in range(399):
        point = rng.uniform(-1.0, 1.0, 2)
        parent = tree.nearest(point)
        way = point - tree.states[parent]
        tree.extend(parent, tree.states[parent] + way * min(1.0, 0.1 / np.linalg.norm(way)))
        lengths.append(tree.costs.copy())
    assert len(tree) > 300
    for before, after in itertools.pairwise(lengths):
        assert (after[: len(before)] <= before + 1e-12).all()
    for index in range(len(tree)):
        steps = np.diff(tree.path_to(index), axis=0)
        assert tree.costs[index] == pytest.approx(np.hypot(*steps.T).sum())
    # In free space RRT*'s ways are nearly straight.
    straight = np.linalg.norm(tree.states, axis=1)[1:]
    assert np.median(tree.costs[1:] / straight) < 1.1


def test_a_state_behind_an_obstacle_is_not_added():
    tree = SearchTree(np.zeros(2), 5, 1.0, lambda a, b: False)
    assert tree.extend(0, np.array((0.1, 0.0))) is None
    assert len(tree) == 1


def test_the_coarse_map_keeps_the_free_area():
    blocked = np.random.default_rng(0).random((37, 53)) < 0.3
    parts = free_parts(blocked, 10)
    assert parts.shape == (10, 10)
    assert parts.min() >= 0.0
    assert parts.max() <= 1.0 + 1e-6
    # Beyond the map all is blocked.
    assert parts.sum() * 5.3**2 == pytest.approx((~blocked).sum(), rel=1e-5)
    assert parts[7:].max() == 0.0
    assert square_side(blocked, 0.1) == pytest.approx(5.3)
    np.testing.assert_allclose(normalised([(0.0, 5.3)], 5.3), [(-1.0, 1.0)])


def test_visits_count_for_what_is_near():
    states = np.random.default_rng(0).random((6, 2))
    visits = SmoothedVisits(6, radius=0.5)
    assert [visits.note(state) for state in states] == list(range(6))
    distances = np.linalg.norm(states[:, None] - states, axis=-1)
    expected = np.exp(-((distances / 0.5) ** 2)).sum(axis=1)
    np.testing.assert_allclose(visits.counts, expected)
    np.testing.assert_allclose(visits.at(states), expected)
    np.testing.assert_allclose(visits.at(np.array([(9.0, 9.0)])), [0.0], atol=1e-12)
