from __future__ import annotations

import numpy as np
import pytest

import planformer as pf
from planformer.bench.guides import (
    LazyThetaProposer,
    PathProposer,
    Variant,
    WavefrontProposer,
    fingerprints,
    variants,
)
from planformer.bench.problems import make_problem
from planformer.bench.rows import GeneratedMaps, Row, Scene
from planformer.data.experts import shortest_path
from planformer.encoding import LABEL_DISTANCE
from planformer.errors import UnknownGuide
from planformer.geometry import distance_to_polyline
from planformer.planning import Problem


@pytest.fixture(scope="module")
def maze():
    row = Row("maze", (Scene("", GeneratedMaps("maze", 9.0, 7.3), pf.PointRobot()),))
    return make_problem(row, 0, seed=0)


def test_the_ideal_region_is_that_of_the_labels(maze, on_path):
    region = PathProposer(maze.reference).propose(maze.problem)
    near = distance_to_polyline(region.anchors, maze.reference) <= LABEL_DISTANCE
    np.testing.assert_array_equal(region.selected.ravel(), near)
    assert region.connected
    assert on_path(region, maze.problem, maze.reference)
    assert region.share < 0.8


@pytest.mark.parametrize("resolution", [0.025, 0.05, 0.07])
def test_the_ideal_region_fits_maps_of_any_resolution_and_pose(resolution, on_path):
    occupied = pf.generate_forest(2, width=8.0, height=6.0).occupied
    grid = pf.OccupancyGrid(occupied, 0.05, origin=(-3.0, 2.0, 0.7)).resampled(resolution)
    robot = pf.PointRobot()
    ends = [grid.nearest_free(grid.frame.to_world(xy), 0.1) for xy in ((1.0, 1.0), (7.0, 5.0))]
    problem = Problem(grid, robot, *ends)
    path = shortest_path(grid, robot.radius, *ends)
    region = PathProposer(path).propose(problem)
    assert region.connected
    assert on_path(region, problem, path)


def test_the_ideal_region_of_a_car_has_the_headings_of_the_path(car_row):
    known = make_problem(car_row, 0, seed=0)
    region = PathProposer(known.reference).propose(known.problem)
    at = known.reference[len(known.reference) // 2]
    nearest = np.hypot(*np.moveaxis(region.anchors - at[:2], -1, 0)).argmin()
    assert abs(pf.geometry.wrap_angle(region.headings.flat[nearest] - at[2])) < 1.2


def test_the_corridor_follows_the_shortest_path_of_a_car_too(maze, car_row):
    corridor = LazyThetaProposer().propose(maze.problem)
    ideal = PathProposer(maze.reference).propose(maze.problem)
    np.testing.assert_array_equal(corridor.mask, ideal.mask)
    car = make_problem(car_row, 0, seed=0).problem
    path = shortest_path(car.grid, car.robot.radius, car.start[:2], car.goal[:2])
    region = LazyThetaProposer().propose(car)
    sampling = region.sampling()
    centres = sampling.anchors + sampling.offsets
    np.testing.assert_allclose(distance_to_polyline(centres, path), 0.0, atol=1e-9)
    first = np.hypot(*(centres - path[0]).T).argmin()
    along = path[1] - path[0]
    assert abs(pf.geometry.wrap_angle(sampling.headings[first] - np.arctan2(*along[::-1]))) < 1.0


def test_without_a_way_the_corridor_is_not_connected():
    occupied = np.zeros((100, 100), bool)
    occupied[:, 50] = True
    problem = Problem(pf.OccupancyGrid(occupied), pf.PointRobot(), (1.0, 1.0), (4.0, 1.0))
    region = LazyThetaProposer().propose(problem)
    assert not region.connected


def test_the_wavefront_connects_a_maze(maze):
    fixed = WavefrontProposer(0.5).propose(maze.problem)
    assert fixed.connected
    assert fixed.share < 0.9
    assert WavefrontProposer(None).propose(maze.problem).connected


def test_guides_that_need_headings_have_none_in_the_plane(small_row, car_row, heading_weights):
    guides = ("mpt", heading_weights, "ideal", "wavefront")
    expected = [
        Variant(guide, threshold)
        for guide, threshold in (
            ("mpt", "fixed"),
            ("mpt", "connecting"),
            (heading_weights, "fixed"),
            (heading_weights, "connecting"),
            ("ideal", "fixed"),
            ("wavefront", "fixed"),
            ("wavefront", "connecting"),
        )
    ]
    assert list(variants(guides, car_row)) == expected
    assert [v for v in expected if v.guide != heading_weights] == list(variants(guides, small_row))


def test_the_threshold_is_the_rules(small_row):
    problem = make_problem(small_row, 0, seed=0)
    for guide in ("mpt", "wavefront"):
        fixed = Variant(guide, "fixed").proposer(problem.reference).propose(problem.problem)
        assert fixed.threshold == 0.5
        connecting = Variant(guide, "connecting").proposer(problem.reference)
        assert connecting.propose(problem.problem).connected


def test_fingerprints_tell_networks_apart(broken_weights, tmp_path):
    prints = fingerprints(("mpt", "mpt_small.forest_maze_indoor", "ideal"))
    assert prints["mpt"] == prints["mpt_small.forest_maze_indoor"] != prints["ideal"]
    with pytest.raises(UnknownGuide):
        fingerprints(("nothing",))
