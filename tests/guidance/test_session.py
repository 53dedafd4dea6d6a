"""A map session plans as `plan` does, only that it keeps what it knows."""

from __future__ import annotations

import numpy as np
import pytest

import planformer as pf
from planformer.data.problems import random_problems
from planformer.errors import GoalOccupied, InvalidParameter, UnknownGuide

ROBOT = pf.PointRobot(radius=0.1)


@pytest.fixture(scope="module")
def forest():
    return pf.generate_forest(seed=1, width=12.0, height=12.0)


def _queries(grid, count):
    problems = random_problems(grid, ROBOT, min_distance=3.0, rng=np.random.default_rng(2))
    return [(p.start, p.goal) for p, _ in zip(problems, range(count), strict=False)]


def test_it_plans_as_plan_does(forest):
    session = pf.MapSession(forest, ROBOT)
    for start, goal in _queries(forest, 3):
        ours = session.plan(start, goal, seed=3, max_vertices=200)
        theirs = pf.plan(forest, ROBOT, start, goal, seed=3, max_vertices=200)
        assert ours.path.tolist() == theirs.path.tolist()
        region = session.propose_region(start, goal)
        assert (region.mask == theirs.region.mask).all()


def test_all_queries_at_once_give_what_they_give_one_by_one(forest):
    session, queries = pf.MapSession(forest, ROBOT, threshold=0.5), _queries(forest, 12)
    options = {"planner": "BITstar", "seed": 4, "max_vertices": 300}
    at_once = session.plan_all(iter(queries), workers=3, **options)
    one_by_one = [session.plan(*query, **options) for query in queries]
    assert [r.path.tolist() for r in at_once] == [r.path.tolist() for r in one_by_one]
    assert all(r.region.threshold == 0.5 for r in at_once)
    assert session.plan_all([]) == []


def test_a_query_may_have_a_guide_of_its_own(forest):
    session, queries = pf.MapSession(forest, ROBOT), _queries(forest, 2)
    options = {"guide": None, "seed": 1, "max_vertices": 100}
    results = [session.plan(*queries[0], **options), *session.plan_all(queries, **options)]
    assert [result.region for result in results] == [None] * 3


def test_a_new_map_counts_from_the_next_query_on(forest):
    session = pf.MapSession(forest, ROBOT, guide=None)
    (start, goal), *_ = _queries(forest, 1)
    assert session.plan(start, goal, seed=1, max_vertices=2000).solved
    occupied = forest.occupied.copy()
    row, col = forest.to_rc(goal)
    occupied[row - 5 : row + 6, col - 5 : col + 6] = True
    session.update(pf.OccupancyGrid(occupied, forest.resolution, forest.origin))
    assert session.grid.occupied[row, col]
    with pytest.raises(GoalOccupied):
        session.plan(start, goal)


def test_what_is_wrong_is_told_at_once(forest):
    with pytest.raises(UnknownGuide, match="valid"):
        pf.MapSession(forest, ROBOT, guide="nothing")
    with pytest.raises(InvalidParameter, match="threshold"):
        pf.MapSession(forest, ROBOT, threshold=2.0)
    with pytest.raises(InvalidParameter, match="threshold needs"):
        pf.MapSession(forest, ROBOT, guide=None, threshold=0.5)
    session = pf.MapSession(forest, ROBOT, guide=None)
    with pytest.raises(InvalidParameter, match="workers"):
        session.plan_all(_queries(forest, 2), workers=0)
    with pytest.raises(UnknownGuide, match="no guide"):
        session.propose_region((1.0, 1.0), (2.0, 2.0))
    queries = [*_queries(forest, 3), ((-1.0, 0.0), (1.0, 1.0))]
    with pytest.raises(pf.PlanformerError, match="outside the map"):
        session.plan_all(queries, max_vertices=50)


@pytest.mark.parametrize("bad", [None, ((-1.0, 0.0), (1.0, 1.0))])
def test_a_query_that_fails_ends_the_others(forest, bad):
    session = pf.MapSession(forest, ROBOT, guide=None)
    endless = {"time_limit": 3600.0, "target_length": 0.01}
    with pytest.raises((TypeError, pf.PlanformerError), match=r"iterable|outside the map"):
        session.plan_all([*_queries(forest, 3), bad], workers=4, **endless)


def test_a_query_that_fails_cancels_the_token_of_all(forest):
    token = pf.CancelToken()
    endless = {"time_limit": 3600.0, "target_length": 0.01, "cancel": token}
    queries = [*_queries(forest, 3), ((-1.0, 0.0), (1.0, 1.0))]
    with pytest.raises(pf.PlanformerError, match="outside the map"):
        pf.MapSession(forest, ROBOT, guide=None).plan_all(queries, workers=4, **endless)
    assert token.is_cancelled


def test_all_queries_can_be_cancelled(forest):
    token = pf.CancelToken()
    token.cancel()
    results = pf.MapSession(forest, ROBOT).plan_all(_queries(forest, 3), cancel=token)
    assert [result.status.value for result in results] == ["cancelled"] * 3


def test_a_query_that_fails_ends_the_others_without_a_token_too(forest):
    queries = [*_queries(forest, 3), ((-1.0, 0.0), (1.0, 1.0))]
    endless = {"time_limit": 3600.0, "target_length": 0.01, "cancel": None}
    with pytest.raises(pf.PlanformerError, match="outside the map"):
        pf.MapSession(forest, ROBOT, guide=None).plan_all(queries, workers=4, **endless)
