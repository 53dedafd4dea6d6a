from __future__ import annotations

from dataclasses import dataclass
from itertools import islice

import numpy as np
import pytest

import planformer as pf
from planformer.data.experts import hybrid_astar
from planformer.data.problems import draw_problems, random_problems
from planformer.encoding import NetworkScale
from planformer.errors import InvalidParameter, InvalidWeights, UnknownGuide, WeightsMismatch
from planformer.geometry import distance_to_polyline, polyline_length
from planformer.guidance import make_region
from planformer.planning import PlanStatus, Problem, planner_names

REAL_MAPS = [
    ("depot.yaml", None, 0.1),
    ("tb3_sandbox.yaml", None, 0.1),
    ("mrpb_office02.yaml", None, 0.1),
    ("NewYork_0_512.map", 0.05, 0.1),
    ("32room_000.map", 0.2, 0.1),
]


def _same_ends(result, start, goal):
    np.testing.assert_array_equal(result.path[0], start)
    np.testing.assert_array_equal(result.path[-1], goal)


@pytest.mark.parametrize("planner", ["RRTstar", "InformedRRTstar", "BITstar"])
@pytest.mark.parametrize(("name", "resolution", "radius"), REAL_MAPS)
def test_guided_plans_on_real_maps(real_maps, name, resolution, radius, planner):
    grid, robot = pf.load_map(real_maps / name, resolution=resolution), pf.PointRobot(radius)
    rng = np.random.default_rng(7)
    distance = 0.4 * min(grid.width, grid.height) if name != "tb3_sandbox.yaml" else 2.0
    (start,), (goal,) = draw_problems(grid, radius, 1, min_distance=distance, rng=rng)
    shortest = pf.plan(grid, robot, start, goal, planner="FMT", guide=None, time_limit=None, seed=1)
    result = pf.plan(
        grid,
        robot,
        start,
        goal,
        planner=planner,
        target_length=1e4,
        time_limit=60.0,
        seed=1,
    )
    assert result.solved
    assert result.region.connected
    assert result.proposal_seconds > 0
    assert pf.path_is_valid(grid, robot, result.path)
    _same_ends(result, start, goal)
    assert not shortest.solved or result.length < 2.0 * shortest.length


@pytest.mark.parametrize("kind", [pf.generate_forest, pf.generate_maze, pf.generate_indoor])
@pytest.mark.parametrize("seed", range(30_000, 30_005))
def test_the_shipped_region_holds_a_nearly_shortest_path(kind, seed):
    from planformer.data.experts import shortest_path
    from planformer.geometry import polyline_length

    grid, robot = kind(seed), pf.PointRobot()
    rng = np.random.default_rng(seed)
    (start,), (goal,) = draw_problems(grid, robot.radius, 1, min_distance=8.0, rng=rng)
    region = pf.propose_region(grid, robot, start, goal)
    outside = pf.OccupancyGrid(grid.blocked(robot.radius) | ~region.mask, grid.resolution)
    inside = shortest_path(outside, 0.0, start, goal)
    assert inside is not None
    best = shortest_path(grid, robot.radius, start, goal)
    assert polyline_length(inside) < 1.1 * polyline_length(best)
    assert region.share < 0.6  # of a maze; a forest's is a tenth


@dataclass
class Corner:
    """Proposes the way round the upper left corner of `block`."""

    def propose(self, problem: Problem) -> pf.Region:
        lattice = np.stack(np.meshgrid(np.arange(12) + 0.5, np.arange(12) + 0.5), axis=-1)
        path = np.array([[1.5, 1.5], [1.5, 10.5], [10.5, 10.5]])
        near = distance_to_polyline(lattice.reshape(-1, 2), path) < 0.7
        return make_region(problem, near.reshape(12, 12).astype(np.float32), NetworkScale())


@pytest.fixture
def block() -> Problem:
    """12 m x 12 m with a block between start and goal; both ways round it are as long."""
    occupied = np.zeros((240, 240), bool)
    occupied[60:180, 60:180] = True
    return Problem(pf.OccupancyGrid(occupied), pf.PointRobot(), (1.5, 1.5), (10.5, 10.5))


@pytest.mark.parametrize("planner", planner_names(pf.PointRobot()))
def test_every_planner_samples_the_region(block, planner):
    result = pf.plan(
        block.grid,
        block.robot,
        block.start,
        block.goal,
        planner=planner,
        guide=Corner(),
        max_vertices=150,
        time_limit=20.0,
        seed=3,
        keep_tree=True,
    )
    assert result.solved
    rows, cols = block.grid.to_rc(result.tree.vertices).T
    # A tree also grows states on the way to a sample, which may lie beside the region.
    assert result.region.mask[rows, cols].mean() > 0.8


def test_exploration_finds_what_the_region_misses(room):
    @dataclass
    class Nowhere:
        def propose(self, problem: Problem) -> pf.Region:
            probability = np.zeros((4, 6), np.float32)
            probability[0, 0] = 1.0
            return make_region(problem, probability, NetworkScale(), threshold=0.5)

    def solved(exploration: float) -> bool:
        return pf.plan(
            room.grid,
            room.robot,
            room.start,
            room.goal,
            guide=Nowhere(),
            exploration=exploration,
            target_length=100.0,
            max_vertices=400,
            time_limit=20.0,
            seed=1,
        ).solved

    assert solved(0.5)
    assert not solved(0.0)


def test_a_plan_refines_its_path_unless_told_not_to(room):
    def planned(**options):
        return pf.plan(
            room.grid,
            room.robot,
            room.start,
            room.goal,
            planner="RRTstar",
            max_vertices=600,
            time_limit=60.0,
            seed=1,
            **options,
        )

    assert planned().length == planned(refinement=0.5).length < planned(refinement=0.0).length


def test_guide_none_is_an_unguided_plan(room):
    result = pf.plan(room.grid, room.robot, room.start, room.goal, guide=None, max_vertices=300)
    assert result.region is None
    assert result.proposal_seconds == 0.0


def test_the_same_seed_gives_the_same_guided_path(room):
    paths = [
        pf.plan(room.grid, room.robot, room.start, room.goal, max_vertices=300, seed=11).path
        for _ in range(2)
    ]
    np.testing.assert_array_equal(*paths)


@pytest.mark.parametrize(
    ("robot", "planner", "unguided", "guide"),
    [
        (pf.PointRobot(radius=0.1), "BITstar", "InformedRRTstar", "mpt"),
        (pf.DubinsCar(radius=0.1, turning_radius=0.3), *["InformedRRTstar"] * 2, "mpt-dubins"),
        (pf.ReedsSheppCar(radius=0.1, turning_radius=0.3), *["InformedRRTstar"] * 2, "mpt-dubins"),
    ],
)
def test_defaults_suit_the_robot(room, robot, planner, unguided, guide):
    assert pf.default_guide(robot) == guide
    assert pf.default_planner(robot) == planner
    assert pf.default_planner(robot, guided=False) == unguided
    yaws = () if robot.state_dimension == 2 else (1.5,)
    ends = (*room.start, *yaws), (*room.goal, *yaws)
    limits = {"max_vertices": 200, "seed": 1, "keep_tree": True}
    by_default = pf.plan(room.grid, robot, *ends, **limits)
    named = pf.plan(room.grid, robot, *ends, planner=planner, guide=guide, **limits)
    np.testing.assert_array_equal(by_default.tree.vertices, named.tree.vertices)
    session = pf.MapSession(room.grid, robot)
    np.testing.assert_array_equal(session.plan(*ends, **limits).path, named.path)
    region = pf.propose_region(room.grid, robot, *ends)
    np.testing.assert_array_equal(region.probability, named.region.probability)


def test_a_car_is_guided_by_weights_without_headings(room):
    car = pf.DubinsCar(radius=0.1, turning_radius=0.3)
    start, goal = (*room.start, 1.5), (*room.goal, -1.5)
    result = pf.plan(
        room.grid, car, start, goal, guide="mpt", target_length=100.0, time_limit=30.0, seed=1
    )
    assert result.solved
    assert result.region.headings is None
    _same_ends(result, start, goal)


def test_a_network_with_headings_guides_a_car_along_them(room, make_weights):
    weights = str(make_weights(headings=True))
    car = pf.DubinsCar(radius=0.1, turning_radius=0.3)
    region = pf.propose_region(room.grid, car, (*room.start, 0.0), (*room.goal, 0.0), guide=weights)
    np.testing.assert_allclose(region.headings, np.pi / 2 + room.grid.frame.yaw)


@pytest.fixture(scope="module")
def car_problems():
    """Problems for the car that the weights know, on forests that lie askew in the world."""
    car, problems = pf.DubinsCar(radius=0.2, turning_radius=0.549), []
    for seed in range(4000, 4006):
        made = pf.generate_forest(seed, width=24.0, height=24.0)
        grid = pf.OccupancyGrid(made.occupied, made.resolution, origin=(5.0, -3.0, 0.8))
        rng = np.random.default_rng(seed)
        drawn = random_problems(grid, car, min_distance=4.0, max_distance=15.0, rng=rng)
        solved = ((problem, hybrid_astar(problem, 100_000)) for problem in islice(drawn, 10))
        problems.append(next((problem, path) for problem, path in solved if path is not None))
    return problems


def test_the_shipped_headings_run_along_good_paths(car_problems):
    agreement = []
    for problem, path in car_problems:
        region = pf.propose_region(
            problem.grid, problem.robot, problem.start, problem.goal, guide="mpt-dubins"
        )
        nearest = np.hypot(*(region.anchors[..., None, :] - path[:, :2]).transpose(3, 0, 1, 2))
        off = region.headings - path[nearest.argmin(axis=2), 2]
        agreement.append(np.cos(off)[nearest.min(axis=2) < 0.5].mean())
        assert (region.yaw_deviations >= 0.1).all()
    assert np.median(agreement) > 0.8


def test_the_shipped_weights_guide_the_car(car_problems):
    solved = 0
    for problem, path in car_problems:
        result = pf.plan(
            problem.grid,
            problem.robot,
            problem.start,
            problem.goal,
            guide="mpt-dubins",
            max_vertices=500,
            time_limit=60.0,
            target_length=1.1 * polyline_length(path[:, :2]),
            seed=1,
        )
        solved += result.status is PlanStatus.TARGET_REACHED
        if result.solved:
            _same_ends(result, problem.start, problem.goal)
            assert pf.path_is_valid(problem.grid, problem.robot, result.path)
    assert solved >= 4  # of six; the sixth is not found in 500 vertices


def test_a_network_with_headings_does_not_fit_a_point(room, make_weights):
    with pytest.raises(WeightsMismatch, match="PointRobot"):
        pf.propose_region(
            room.grid, room.robot, room.start, room.goal, guide=str(make_weights(headings=True))
        )


def test_values_that_are_no_number_are_refused(room, make_weights):
    with pytest.raises(InvalidWeights, match="finite"):
        pf.plan(room.grid, room.robot, room.start, room.goal, guide=str(make_weights(float("nan"))))


def test_a_guide_must_propose(room):
    class Proposer:
        def propose(self, problem): ...

    for guide in (3.0, Proposer):  # a class proposes nothing, its objects do
        with pytest.raises(UnknownGuide, match="RegionProposer"):
            pf.plan(room.grid, room.robot, room.start, room.goal, guide=guide)
    with pytest.raises(UnknownGuide, match="a path or a RegionProposer"):
        pf.propose_region(room.grid, room.robot, room.start, room.goal, guide=None)


def test_a_guide_may_be_a_path(room, make_weights):
    path = make_weights(0.75)
    regions = [
        pf.propose_region(room.grid, room.robot, room.start, room.goal, guide=guide)
        for guide in (path, str(path))
    ]
    assert regions[0].probability.tolist() == regions[1].probability.tolist()


@pytest.mark.parametrize("threshold", [-0.1, 1.5, float("nan")])
def test_a_threshold_is_a_probability(room, threshold):
    with pytest.raises(InvalidParameter, match="threshold"):
        pf.propose_region(room.grid, room.robot, room.start, room.goal, threshold=threshold)


def test_a_threshold_needs_a_guide(room):
    with pytest.raises(InvalidParameter, match="threshold needs"):
        pf.plan(room.grid, room.robot, room.start, room.goal, guide=None, threshold=0.5)


@pytest.mark.parametrize("shape", [(1, 1), (7, 300), (333, 41)])
def test_any_size_gets_a_region(shape):
    grid = pf.OccupancyGrid(np.zeros(shape, bool), 0.05)
    height, width = shape[0] * 0.05, shape[1] * 0.05
    robot = pf.PointRobot(radius=0.0)
    region = pf.propose_region(grid, robot, (0.01, 0.01), (width - 0.01, height - 0.01))
    assert region.connected
    assert region.mask.shape == shape


@pytest.mark.parametrize("reason", ["unreachable", "cancelled"])
def test_nothing_is_proposed_where_nothing_is_searched(room, reason):
    @dataclass
    class Counting:
        proposals: int = 0

        def propose(self, problem):
            self.proposals += 1
            return pf.propose_region(problem.grid, problem.robot, problem.start, problem.goal)

    grid, token, guide = room.grid, pf.CancelToken(), Counting()
    if reason == "unreachable":
        occupied = grid.occupied.copy()
        occupied[:, grid.to_rc(room.start)[1] + 10] = True
        grid = pf.OccupancyGrid(occupied, grid.resolution, grid.origin)
    else:
        token.cancel()
    result = pf.plan(grid, room.robot, room.start, room.goal, guide=guide, cancel=token)
    assert (result.status.value, result.region, guide.proposals) == (reason, None, 0)
    assert pf.plan(room.grid, room.robot, room.start, room.goal, guide=guide, time_limit=1.0).solved
    assert guide.proposals == 1
