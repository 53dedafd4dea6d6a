"""Where the samplers of the core draw, and that every planner draws there."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import planformer as pf
from planformer import _core
from planformer.errors import InvalidParameter
from planformer.geometry import wrap_angle
from planformer.planning import Problem, SamplingRegion, SearchLimits, planner_names, search
from planformer.planning.sampling import ELLIPSE_ASPECT, YAW_DEVIATION

from .conftest import DUBINS, POINT, REEDS_SHEPP

SAMPLING = ["RRTstar", "InformedRRTstar", "SORRTstar", "BITstar", "ABITstar", "AITstar", "FMT"]
SAMPLING += ["BFMT", "PRMstar", "LazyPRMstar", "RRTsharp", "RRTXstatic", "RRT", "RRTConnect"]


def region_of(anchors, headings=None, half_width=0.4):
    anchors = np.asarray(anchors, float)
    area = len(anchors) * (2 * half_width) ** 2
    return SamplingRegion(anchors, headings, half_width, area)


def draw(anchors, headings, half_width, count, seed=1, offsets=None):
    poses = np.column_stack((anchors, np.zeros(len(anchors)) if headings is None else headings))
    offsets = None if offsets is None else np.asarray(offsets, float)
    region = _core.Region(
        poses,
        np.zeros((len(poses), 2)) if offsets is None else offsets,
        has_heading=headings is not None,
        half_width=half_width,
        minor_axis=SamplingRegion(
            poses[:, :2], headings, half_width, area=1.0, offsets=offsets
        ).minor_axis,
        yaw_deviations=np.full(len(poses), YAW_DEVIATION),
        ends=None,
        area=1.0,
    )
    return region.sample(count, seed)


@settings(max_examples=30)
@given(st.floats(-50, 50), st.floats(-50, 50), st.floats(0.01, 10), st.integers(0, 2**32 - 1))
def test_squares_are_filled_evenly(x, y, half_width, seed):
    samples = draw([(x, y)], None, half_width, 4000, seed)
    unit = (samples[:, :2] - (x, y)) / half_width
    assert np.abs(unit).max() <= 1 + 1e-12
    quadrants = np.histogram2d(unit[:, 0], unit[:, 1], bins=2, range=[(-1, 1), (-1, 1)])[0]
    assert np.abs(quadrants - 1000).max() < 200  # seven standard deviations
    assert np.abs(samples[:, 2]).max() <= np.pi
    assert np.hypot(np.cos(samples[:, 2]).mean(), np.sin(samples[:, 2]).mean()) < 0.1


@settings(max_examples=30)
@given(st.floats(-np.pi, np.pi), st.floats(0.01, 10), st.integers(0, 2**32 - 1))
def test_ellipses_lie_along_the_heading(heading, half_width, seed):
    samples = draw([(3.0, -2.0)], np.array([heading]), half_width, 4000, seed)
    c, s = np.cos(heading), np.sin(heading)
    offset = (samples[:, :2] - (3.0, -2.0)) @ np.array([(c, -s), (s, c)])
    unit = offset / (half_width, ELLIPSE_ASPECT * half_width)
    radius = np.hypot(*unit.T)
    assert radius.max() <= 1 + 1e-9
    # Even over the area: half of the samples are within 1 / sqrt(2) of the centre.
    assert abs((radius < np.sqrt(0.5)).mean() - 0.5) < 0.06
    assert np.abs(unit.mean(axis=0)).max() < 0.06
    turn = wrap_angle(samples[:, 2] - heading)
    assert abs(turn.mean()) < 0.04
    assert turn.std() == pytest.approx(YAW_DEVIATION, rel=0.08)


def test_each_anchor_has_its_own_spread_of_the_yaw():
    deviations = np.array([0.1, 0.8])
    region = _core.Region(
        np.array([(0.0, 0.0, 1.0), (10.0, 0.0, -2.0)]),
        np.zeros((2, 2)),
        has_heading=True,
        half_width=0.4,
        minor_axis=0.2,
        yaw_deviations=deviations,
        ends=None,
        area=1.0,
    )
    samples = region.sample(8000, 1)
    for anchor, heading, deviation in zip((0.0, 10.0), (1.0, -2.0), deviations, strict=True):
        near = np.abs(samples[:, 0] - anchor) < 1.0
        turn = wrap_angle(samples[near, 2] - heading)
        assert turn.std() == pytest.approx(deviation, rel=0.06)


def test_some_samples_are_poses_after_the_start_or_before_the_goal():
    start, goal, radius = (20.0, 5.0, 0.3), (40.0, 5.0, -1.0), 0.5
    region = _core.Region(
        np.zeros((1, 3)),
        np.zeros((1, 2)),
        has_heading=True,
        half_width=0.8,
        minor_axis=0.4,
        yaw_deviations=np.array([0.1]),
        ends=_core.Ends(list(start), list(goal), radius),
        area=1.0,
    )
    samples = region.sample(8000, 1)
    after, before = (samples[np.abs(samples[:, 0] - end[0]) < 5.0] for end in (start, goal))
    longest = 2 * 2.5 * radius
    for near in (after, before):
        assert 0.08 < len(near) / len(samples) < 0.12
    ends = np.tile(start, (len(after), 1)), np.tile(goal, (len(before), 1))
    assert _core.curve_lengths(ends[0], after, radius, False).max() <= longest + 1e-6
    assert _core.curve_lengths(before, ends[1], radius, False).max() <= longest + 1e-6
    assert (np.abs(samples[:, :2]).max(axis=1) <= 0.8).mean() == pytest.approx(0.8, abs=0.02)


def test_a_spread_for_each_anchor_is_needed():
    anchors, headings = np.zeros((2, 2)), np.zeros(2)
    for deviations in (np.ones(3), np.array([1.0, 0.0]), np.array([1.0, np.nan])):
        with pytest.raises(InvalidParameter, match="yaw_deviations must be 2"):
            SamplingRegion(anchors, headings, 0.4, 1.0, deviations)
    with pytest.raises(InvalidParameter, match="go with headings"):
        SamplingRegion(anchors, None, 0.4, 1.0, np.ones(2))


@settings(max_examples=30)
@given(
    st.lists(st.tuples(*4 * [st.floats(-0.4, 0.4)], st.floats(-4, 4)), min_size=1, max_size=5),
    st.booleans(),
)
def test_moved_shapes_stay_in_the_squares_of_the_anchors(rows, has_headings):
    values = np.array(rows)
    anchors = np.round(10 * values[:, :2]) * 0.3
    headings = values[:, 4] if has_headings else None
    samples = draw(anchors, headings, 0.4, 500, offsets=values[:, 2:4])
    apart = np.abs(samples[:, None, :2] - anchors).max(axis=2)
    assert apart.min(axis=1).max() <= 0.4 + 1e-6


def test_shapes_move_by_their_offsets():
    anchors = [(0.0, 0.0), (10.0, 0.0)]
    offsets = [(0.0, 0.3), (0.0, -0.1)]
    samples = draw(anchors, np.zeros(2), 0.4, 8000, offsets=offsets)
    for x, y in ((0.0, 0.3), (10.0, -0.1)):
        near = samples[np.abs(samples[:, 0] - x) < 1.0]
        assert near[:, 0].mean() == pytest.approx(x, abs=0.02)
        above, below = (near[:, 1] > y).sum(), (near[:, 1] < y).sum()
        # The part above 0.4 is cut off.
        assert (0.6 < above / below < 0.9) if y == 0.3 else (0.9 < above / below < 1.1)


def test_offsets_of_another_shape_are_refused():
    with pytest.raises(InvalidParameter, match="offsets must have shape"):
        SamplingRegion(np.zeros((2, 2)), None, 0.4, 1.0, offsets=np.zeros(2))
    with pytest.raises(InvalidParameter, match="offsets must be finite"):
        SamplingRegion(np.zeros((2, 2)), None, 0.4, 1.0, offsets=np.full((2, 2), np.nan))


def test_anchors_are_drawn_equally_often():
    anchors = [(float(k), 0.0) for k in range(10)]
    samples = draw(anchors, None, 0.4, 10_000)
    counts = np.bincount(np.round(samples[:, 0]).astype(int), minlength=10)
    assert np.abs(counts - 1000).max() < 200


@pytest.fixture(scope="module")
def two_rooms():
    """Two rooms that join at the top; start and goal are at the bottom."""
    occupied = np.zeros((120, 120), bool)
    occupied[[0, -1]] = occupied[:, [0, -1]] = True
    occupied[:90, 55:65] = True
    return pf.OccupancyGrid(occupied, 0.05, origin=(4.0, -1.0, 1.0))


def problem_in(grid, robot, start=(1.0, 1.0, 1.57), goal=(5.0, 1.0, -1.57)):
    ends = grid.frame.to_world([start, goal])[:, : robot.state_dimension]
    return Problem(grid, robot, tuple(ends[0]), tuple(ends[1]))


def way_round(grid, headings=False):
    """Anchors on the way from room to room."""
    corners = np.array([(1.0, 1.0), (1.0, 5.2), (5.0, 5.2), (5.0, 1.0)])
    legs = [np.linspace(a, b, 12) for a, b in itertools.pairwise(corners)]
    yaw = np.repeat([np.pi / 2, 0.0, -np.pi / 2], 12) + grid.origin[2]
    return region_of(grid.frame.to_world(np.concatenate(legs)), yaw if headings else None)


def in_region(region, grid, points):
    offset = grid.frame.to_local(points)[:, None] - grid.frame.to_local(region.anchors)
    return (np.abs(offset).max(axis=-1) <= region.half_width * (1 + 1e-9)).any(axis=1)


@pytest.mark.parametrize("planner", SAMPLING)
def test_every_planner_samples_the_region(two_rooms, planner):
    region = way_round(two_rooms)
    result = search(
        problem_in(two_rooms, POINT),
        planner,
        region=region,
        refinement=0.0,
        limits=SearchLimits(30.0, max_vertices=400),
        seed=3,
        keep_tree=True,
    )
    assert result.solved
    inside = in_region(region, two_rooms, result.tree.vertices)
    # Extensions of limited length may end between two samples.
    assert inside.mean() > (0.7 if planner in ("RRT", "RRTConnect") else 0.9)
    unguided = search(
        problem_in(two_rooms, POINT),
        planner,
        refinement=0.0,
        limits=SearchLimits(30.0, max_vertices=400),
        seed=3,
        keep_tree=True,
    )
    assert in_region(region, two_rooms, unguided.tree.vertices).mean() < inside.mean() - 0.1


@pytest.mark.parametrize("robot", [DUBINS, REEDS_SHEPP], ids=["Dubins", "ReedsShepp"])
@pytest.mark.parametrize("planner", ["RRTstar", "InformedRRTstar", "BITstar", "SST"])
def test_cars_find_their_way_in_a_region_with_headings(two_rooms, robot, planner):
    result = search(
        problem_in(two_rooms, robot),
        planner,
        region=way_round(two_rooms, headings=True),
        exploration=0.1,
        limits=SearchLimits(60.0, target_length=1000.0),
        seed=3,
    )
    assert result.solved


@pytest.mark.parametrize("planner", ["BITstar", "FMT"])
def test_sampled_yaws_follow_the_headings(two_rooms, planner):
    region = way_round(two_rooms, headings=True)
    limits = SearchLimits(30.0, max_vertices=300)
    problem = problem_in(two_rooms, DUBINS)
    tree = search(problem, planner, region=region, limits=limits, seed=1, keep_tree=True).tree
    distance = np.hypot(*np.moveaxis(tree.vertices[:, None, :2] - region.anchors, -1, 0))
    nearest = distance.argmin(axis=1)
    inner = ~np.isin(nearest // 12, [1]) & (distance.min(axis=1) < 0.3)
    turn = wrap_angle(tree.vertices[inner, 2] - region.headings[nearest[inner]])
    assert np.abs(turn).mean() < 2 * YAW_DEVIATION


@pytest.mark.parametrize("planner", SAMPLING)
def test_exploration_gets_out_of_a_region_that_misses_the_way(two_rooms, planner):
    dead_end = region_of(two_rooms.frame.to_world([(1.0, 1.0), (2.0, 1.0), (5.0, 1.0), (4.0, 1.0)]))
    result = search(
        problem_in(two_rooms, POINT),
        planner,
        region=dead_end,
        exploration=0.3,
        limits=SearchLimits(60.0, target_length=1000.0),
        seed=3,
    )
    assert result.solved


def test_exploration_is_the_share_of_samples_outside(two_rooms):
    """BIT* keeps every free sample, so its vertices tell."""
    region = region_of(two_rooms.frame.to_world([(1.0, 1.0), (5.0, 1.0)]), half_width=0.3)
    outside = {}
    for exploration in (0.0, 0.3, 1.0):
        tree = search(
            problem_in(two_rooms, POINT),
            "BITstar",
            region=region,
            exploration=exploration,
            limits=SearchLimits(30.0, max_vertices=1000),
            seed=1,
            keep_tree=True,
        ).tree
        outside[exploration] = 1 - in_region(region, two_rooms, tree.vertices).mean()
    assert outside[0.0] == pytest.approx(0.0, abs=0.01)
    assert outside[0.3] == pytest.approx(0.3, abs=0.08)
    assert outside[1.0] > 0.9


@pytest.mark.parametrize("planner", ["RRTstar", "InformedRRTstar", "BITstar", "AITstar"])
def test_a_region_beside_the_map_does_no_harm(two_rooms, planner):
    region = region_of(two_rooms.frame.to_world([(-50.0, -50.0), (1.0, 5.8), (7.0, 3.0)]))
    limits = SearchLimits(30.0, max_vertices=300)
    result = search(
        problem_in(two_rooms, POINT), planner, region=region, limits=limits, seed=1, keep_tree=True
    )
    assert two_rooms.contains(result.tree.vertices).all()


@pytest.mark.parametrize("planner", planner_names(POINT))
@pytest.mark.parametrize("anchor", [(-50.0, -50.0), (3.0, 2.0)])  # beside the map, in the wall
def test_a_region_without_free_cells_ends_by_the_clock(two_rooms, planner, anchor):
    region = region_of(two_rooms.frame.to_world([anchor]), half_width=0.01)
    limits = SearchLimits(0.1)
    result = search(problem_in(two_rooms, POINT), planner, region=region, limits=limits, seed=1)
    assert result.planning_seconds < 60.0


@pytest.mark.parametrize(
    ("anchors", "headings", "half_width", "area"),
    [
        (np.zeros((0, 2)), None, 1.0, 1.0),
        (np.zeros((3, 3)), None, 1.0, 1.0),
        (np.zeros(2), None, 1.0, 1.0),
        (np.zeros((3, 2)), np.zeros(2), 1.0, 1.0),
        (np.full((3, 2), np.nan), None, 1.0, 1.0),
        (np.zeros((3, 2)), np.full(3, np.inf), 1.0, 1.0),
        (np.zeros((3, 2)), None, 0.0, 1.0),
        (np.zeros((3, 2)), None, np.nan, 1.0),
        (np.zeros((3, 2)), None, np.inf, 1.0),
        (np.zeros((3, 2)), None, 1.0, -1.0),
    ],
)
def test_an_impossible_region_is_an_error(anchors, headings, half_width, area):
    with pytest.raises(InvalidParameter):
        SamplingRegion(anchors, headings, half_width, area)
