"""The learned planners with the weights that are shipped."""

from __future__ import annotations

import pytest

import planformer as pf
from planformer.baselines import learned_planner_names, planner_weights


@pytest.fixture(scope="module")
def forest():
    return pf.generate_forest(seed=3)


def test_they_are_planners_of_a_point_robot():
    assert learned_planner_names(pf.PointRobot()) == ["MPNet", "NEXT-KS"]
    assert not {"MPNet", "NEXT-KS"} & {*pf.planner_names(pf.DubinsCar())}


@pytest.mark.parametrize("name", ["MPNet", "NEXT-KS"])
def test_they_plan_with_the_shipped_weights(forest, name):
    robot = pf.PointRobot()
    plans = [pf.plan(forest, robot, (2.0, 2.0), (7.4, 5.9), planner=name, seed=5) for _ in range(2)]
    assert plans[0].solved
    assert pf.path_is_valid(forest, robot, plans[0].path)
    assert plans[0].path.tolist() == plans[1].path.tolist()
    assert planner_weights(name).card["planner"] == name
