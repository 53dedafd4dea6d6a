"""Every planner of this build, for every robot it offers."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import planformer as pf
from planformer import _core
from planformer.errors import InvalidParameter, UnknownPlanner
from planformer.geometry import polyline_length
from planformer.planning import PlanStatus, Problem, SearchLimits, planner_names, search

from .conftest import DUBINS, EVERY_PLANNER, POINT, REEDS_SHEPP, ROBOTS, random_problem

FIRST_PATH = SearchLimits(60.0, target_length=1000.0)
SMALL = SearchLimits(60.0, max_vertices=150)
"""The seconds end only the searches of a failing test."""


def check(problem, result):
    """What holds for every solved result."""
    assert result.solved, result
    path = result.path
    assert path.shape[1] == problem.robot.state_dimension
    assert tuple(path[0]) == problem.start
    assert tuple(path[-1]) == problem.goal
    assert pf.path_is_valid(problem.grid, problem.robot, path)
    chords = polyline_length(path[:, :2])
    if problem.robot is POINT:
        assert result.length == pytest.approx(chords, rel=1e-9)
    else:
        # An arc of half a cell at this turning radius is at most 0.1 % longer than its chord.
        assert chords * (1 - 1e-9) <= result.length <= chords * 1.001
    assert result.vertices >= 2
    assert result.planning_seconds > 0


@pytest.mark.parametrize(("robot", "planner"), EVERY_PLANNER)
def test_finds_a_valid_path(open_room, robot, planner):
    slow = planner == "FMT" and robot is not POINT  # a million curves before the search begins
    for seed in range(1 if slow else 4):
        problem = random_problem(open_room, robot, seed)
        result = search(problem, planner, limits=FIRST_PATH, seed=seed)
        check(problem, result)
        assert result.status is PlanStatus.TARGET_REACHED


@pytest.mark.parametrize("planner", ["RRTConnect", "RRTstar", "BITstar", "InformedRRTstar"])
@pytest.mark.parametrize("robot", ROBOTS, ids=lambda robot: type(robot).__name__)
def test_paths_are_valid_on_many_maps(robot, planner, forest, maze):
    solved = 0
    indoor = pf.generate_indoor(seed=3, width=12.0, height=9.0)
    for number, grid in enumerate((forest, maze, indoor)):
        for seed in range(3):
            problem = random_problem(grid, robot, 10 * number + seed)
            limits = SearchLimits(0.5, target_length=1000.0)
            result = search(problem, planner, limits=limits, seed=seed)
            assert result.status is not PlanStatus.INVALID_PATH
            if result.solved:
                check(problem, result)
                solved += 1
    assert solved >= 3


@pytest.mark.parametrize("speed", [0.2, 20.0])
def test_sst_drives_slow_and_fast_cars(open_room, speed):
    """A fast car turns more than half round in the usual step."""
    robot = pf.DubinsCar(radius=0.1, turning_radius=0.4, max_speed=speed)
    problem = random_problem(open_room, robot, 1)
    first = search(problem, "SST", limits=FIRST_PATH, seed=1)
    check(problem, first)
    limits = SearchLimits(60.0, target_length=0.9 * first.length, max_vertices=2000)
    result = search(problem, "SST", limits=limits, seed=1)
    check(problem, result)
    assert (result.length <= limits.target_length) == (result.status is PlanStatus.TARGET_REACHED)


@pytest.mark.parametrize("robot", ROBOTS, ids=lambda robot: type(robot).__name__)
def test_a_real_map_is_planned_on(real_maps, robot):
    grid = pf.load_map(real_maps / "depot.yaml")
    problem = random_problem(grid, robot, 1, apart=(2.0, 8.0))
    check(problem, search(problem, "RRTConnect", limits=SearchLimits(30.0), seed=1))


@pytest.mark.parametrize(("robot", "planner"), EVERY_PLANNER)
def test_the_seed_decides_the_result_also_in_parallel_threads(open_room, robot, planner):
    problem = random_problem(open_room, robot, 3)

    def run(seed):
        return search(problem, planner, limits=SMALL, seed=seed, keep_tree=True)

    alone = [run(seed) for seed in (7, 8)]
    with ThreadPoolExecutor(4) as threads:
        together = list(threads.map(run, [7, 8, 7, 8]))
    for result, expected in zip(together, [*alone, *alone], strict=True):
        np.testing.assert_array_equal(result.path, expected.path)
        np.testing.assert_array_equal(result.tree.vertices, expected.tree.vertices)
        assert (result.status, result.vertices) == (expected.status, expected.vertices)
    assert not np.array_equal(alone[0].tree.vertices, alone[1].tree.vertices)


def test_other_searches_leave_a_seeded_one_alone(open_room):
    """OMPL seeds all of a process's generators in turn, those of searches that end as well."""
    searches = [
        (random_problem(open_room, robot, 3), planner, seed)
        for robot, planner in ((POINT, "BITstar"), (POINT, "RRTstar"), (DUBINS, "SST"))
        for seed in (7, 8)
    ]

    def run(number):
        problem, planner, seed = searches[number]
        limits = SearchLimits(60.0, max_vertices=20)
        return search(problem, planner, limits=limits, seed=seed, keep_tree=True).tree.vertices

    alone = [run(number) for number in range(len(searches))]
    numbers = np.random.default_rng(0).integers(len(searches), size=3000)
    with ThreadPoolExecutor(8) as threads:
        for number, vertices in zip(numbers, threads.map(run, numbers), strict=True):
            np.testing.assert_array_equal(vertices, alone[number])


def test_without_a_seed_each_search_is_another(open_room):
    problem = random_problem(open_room, POINT, 3)
    first, second = (search(problem, "RRTstar", limits=SMALL, keep_tree=True) for _ in range(2))
    assert not np.array_equal(first.tree.vertices, second.tree.vertices)


@pytest.mark.parametrize(("robot", "planner"), EVERY_PLANNER)
def test_the_tree_joins_free_vertices(open_room, robot, planner):
    problem = random_problem(open_room, robot, 4)
    result = search(problem, planner, limits=FIRST_PATH, seed=1, keep_tree=True)
    tree = result.tree
    assert len(tree.vertices) == result.vertices
    assert tree.vertices.shape[1] == robot.state_dimension
    assert tree.edges.dtype == np.int64
    assert tree.edges.min() >= 0
    assert tree.edges.max() < len(tree.vertices)
    assert (tree.edges[:, 0] != tree.edges[:, 1]).all()
    cells = open_room.to_rc(tree.vertices[:, :2])
    assert not problem.blocked[cells[:, 0], cells[:, 1]].any()
    for end in (problem.start, problem.goal):
        nearest = np.abs(tree.vertices[:, :2] - end[:2]).max(axis=1).min()
        assert nearest < 1e-9 or (end is problem.goal and planner == "SST")


@pytest.mark.parametrize("planner", [p for p in planner_names(POINT) if p != "LazyPRMstar"])
def test_the_edges_of_a_point_s_tree_are_free(open_room, planner):
    problem = random_problem(open_room, POINT, 4)
    tree = search(problem, planner, limits=FIRST_PATH, seed=1, keep_tree=True).tree
    local = open_room.frame.to_local(tree.vertices)
    for parent, child in tree.edges:
        ends = (*local[parent], *local[child])
        assert _core.segment_is_free(problem.blocked, open_room.resolution, *ends)


def test_no_tree_unless_asked_for(open_room):
    assert search(random_problem(open_room, POINT, 4), "RRT", limits=FIRST_PATH).tree is None


@pytest.mark.parametrize(("robot", "planner"), EVERY_PLANNER)
def test_start_and_goal_in_one_cell(open_room, robot, planner):
    x, y = open_room.to_xy((25, 25))
    yaw = () if robot is POINT else (open_room.origin[2],)
    goal = open_room.frame.to_world(open_room.frame.to_local((x, y)) + (0.01, 0.0))
    problem = Problem(open_room, robot, (float(x), float(y), *yaw), (*goal.tolist(), *yaw))
    result = search(problem, planner, limits=FIRST_PATH, seed=1)
    check(problem, result)
    if planner in ("RRTstar", "BITstar", "InformedRRTstar", "PRMstar"):
        assert result.length == pytest.approx(0.01, rel=1e-3)


@pytest.mark.parametrize(("robot", "planner"), EVERY_PLANNER)
def test_a_goal_that_is_the_start_needs_no_search(open_room, robot, planner):
    state = random_problem(open_room, robot, 1).start
    turned = (*state[:2], *(yaw + 2 * np.pi for yaw in state[2:]))
    for goal in (state, turned):
        result = search(Problem(open_room, robot, state, goal), planner, seed=1)
        assert (result.solved, result.length, result.vertices) == (True, 0.0, 0)
        np.testing.assert_array_equal(result.path, [state, goal])
        assert pf.path_is_valid(open_room, robot, result.path)


def test_a_car_turns_round_to_the_same_place(open_room):
    x, y = open_room.to_xy((20, 90))
    yaw = open_room.origin[2]
    problem = Problem(open_room, REEDS_SHEPP, (x, y, yaw), (x, y, yaw + 2.5))
    for planner in ("RRTstar", "InformedRRTstar", "BITstar"):
        check(problem, search(problem, planner, limits=FIRST_PATH, seed=1))


@pytest.mark.parametrize(
    "planner", ["RRTstar", "InformedRRTstar", "BITstar", "ABITstar", "AITstar"]
)
def test_an_optimal_path_ends_the_search(planner):
    grid = pf.OccupancyGrid(np.zeros((100, 100), bool), 0.05)
    problem = Problem(grid, POINT, (2.0, 2.0), (2.5, 2.2))
    result = search(problem, planner, limits=SearchLimits(60.0), seed=1)
    assert result.status is PlanStatus.FINISHED
    assert result.length == pytest.approx(np.hypot(0.5, 0.2), rel=2e-6)


@pytest.mark.parametrize("robot", ROBOTS, ids=lambda robot: type(robot).__name__)
def test_an_unreachable_goal_is_known_without_a_search(robot):
    occupied = np.zeros((60, 60), bool)
    occupied[:, 30] = True
    occupied[20, 29:32] = True
    grid = pf.OccupancyGrid(occupied, 0.05)
    yaw = (0.0,) * (robot.state_dimension - 2)
    problem = Problem(grid, robot, (0.5, 1.5, *yaw), (2.5, 1.5, *yaw))
    assert not problem.is_connected
    result = search(problem, "RRTstar", limits=SearchLimits(seconds=None))
    assert (result.solved, result.status) == (False, PlanStatus.UNREACHABLE)
    assert result.path.shape == (0, robot.state_dimension)
    assert (result.length, result.vertices) == (np.inf, 0)


def test_diagonal_neighbours_do_not_connect():
    occupied = np.ones((2, 2), bool)
    occupied[0, 0] = occupied[1, 1] = False
    problem = Problem(pf.OccupancyGrid(occupied, 1.0), pf.PointRobot(0.0), (0.5, 0.5), (1.5, 1.5))
    assert search(problem, "RRTstar").status is PlanStatus.UNREACHABLE


@pytest.mark.parametrize("planner", ["RRTstar", "BITstar", "InformedRRTstar", "PRMstar", "FMT"])
def test_a_map_of_one_cell(planner):
    grid = pf.OccupancyGrid(np.zeros((1, 1), bool), 0.05, origin=(1.0, 2.0, 0.3))
    ends = grid.frame.to_world([(0.01, 0.01), (0.04, 0.03)])
    problem = Problem(grid, pf.PointRobot(radius=0.0), tuple(ends[0]), tuple(ends[1]))
    result = search(problem, planner, limits=FIRST_PATH, seed=1)
    assert result.solved
    assert np.hypot(0.03, 0.02) * (1 - 1e-9) <= result.length < 0.05


def test_a_map_of_4000_x_4000_cells_with_a_goal_at_its_border():
    occupied = np.zeros((4000, 4000), bool)
    occupied[1000:3000, 1990:2010] = True
    grid = pf.OccupancyGrid(occupied, 0.05, origin=(-100.0, -100.0))
    problem = Problem(grid, pf.PointRobot(radius=0.0), (-50.0, 0.0), (99.999, -99.999))
    result = search(problem, "RRTConnect", limits=SearchLimits(60.0), seed=1)
    assert result.solved
    assert tuple(result.path[-1]) == problem.goal


def test_an_unknown_planner_is_an_error_that_lists_the_planners_of_the_robot(open_room):
    for robot, unknown in ((POINT, "RRT*"), (POINT, "SST"), (DUBINS, "PRMstar"), (DUBINS, "")):
        problem = random_problem(open_room, robot, 1)
        with pytest.raises(UnknownPlanner) as error:
            search(problem, unknown)
        assert all(name in str(error.value) for name in planner_names(robot))


@pytest.mark.parametrize("name", ["exploration", "refinement"])
@pytest.mark.parametrize("share", [-0.01, 1.01, np.nan, np.inf])
def test_exploration_and_refinement_are_shares(open_room, name, share):
    with pytest.raises(InvalidParameter, match=name):
        search(random_problem(open_room, POINT, 1), "RRT", **{name: share})


@pytest.mark.parametrize("seed", [-1, 2**32, 0.5, "1"])
def test_a_seed_is_a_whole_number_of_32_bits(open_room, seed):
    with pytest.raises(InvalidParameter, match="seed"):
        search(random_problem(open_room, POINT, 1), "RRT", seed=seed)
    there = random_problem(open_room, POINT, 1).start
    with pytest.raises(InvalidParameter, match="seed"):
        search(Problem(open_room, POINT, there, there), "RRT", seed=seed)


@pytest.mark.parametrize("seed", [0, 1, 2**32 - 1, np.int64(5)])
def test_every_seed_of_32_bits_works(open_room, seed):
    problem = random_problem(open_room, POINT, 1)
    assert search(problem, "RRTConnect", limits=FIRST_PATH, seed=seed).solved


def test_prm_star_tells_of_milestones_without_an_edge():
    """Cells that are cut off from all others; OMPL's planner data has nothing of what is there."""
    occupied = np.ones((60, 120), bool)
    occupied[2:58, 2:40] = False
    occupied[20:40, 18:22] = True
    for row, column in np.ndindex(5, 6):
        occupied[12 * row + 1 : 12 * row + 11, 12 * column + 45 : 12 * column + 55] = False
    grid = pf.OccupancyGrid(occupied, 0.05)
    problem = Problem(grid, POINT, (0.5, 1.5), (1.5, 1.5))
    limits = SearchLimits(60.0, max_vertices=30)
    result = search(problem, "PRMstar", limits=limits, seed=1, keep_tree=True)
    assert len(result.tree.vertices) == result.vertices >= 30
    alone = {*range(result.vertices)} - {*result.tree.edges.ravel().tolist()}
    assert len(alone) > 2  # start and goal would be two


@pytest.mark.parametrize("planner", ["BITstar", "ABITstar"])
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_informed_batches_fill_the_way_between_a_cars_poses(planner, seed):
    """Straight lines there are shorter than the curve from start to goal, which bounds the cost."""
    occupied = np.zeros((60, 240), bool)
    occupied[[0, -1]] = occupied[:, [0, -1]] = True
    occupied[22:38, 110:130] = True
    grid = pf.OccupancyGrid(occupied, 0.05)
    problem = Problem(grid, DUBINS, (1.5, 1.5, np.pi / 2), (10.5, 1.5, np.pi / 2))
    limits = SearchLimits(60.0, target_length=10.5, max_vertices=2000)
    result = search(problem, planner, limits=limits, seed=seed, keep_tree=True)
    assert result.solved
    points = result.tree.vertices[:, :2]
    to_ends = (np.linalg.norm(points - end[:2], axis=1) for end in (problem.start, problem.goal))
    detours = sum(to_ends) - 9.0
    assert detours[detours > 1e-6].min() < 0.1  # but for start and goal themselves
