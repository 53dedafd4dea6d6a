from __future__ import annotations

import dataclasses
import math

import planformer as pf
import pytest
from planformer.errors import InvalidParameter, UnknownGuide, UnknownPlanner

from planformer_ros.settings import Settings, Wiring, about


@pytest.mark.parametrize("kind", [Settings, Wiring])
def test_everything_is_described(kind):
    rules = about(kind)
    assert list(rules) == [item.name for item in dataclasses.fields(kind)]
    for name, rule in rules.items():
        assert rule.description
        if isinstance(getattr(kind(), name), float):
            assert rule.between is not None


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("robot", "tank"),
        ("robot_radius", -0.1),
        ("robot_radius", math.nan),
        ("turning_radius", 0.0),
        ("threshold", 1.5),
        ("threshold", -0.5),
        ("exploration", 2.0),
        ("time_limit", 0.0),
        ("time_limit", math.inf),
        ("max_vertices", -1),
        ("seed", 2**32),
    ],
)
def test_bad_values_name_the_rule(name, value):
    with pytest.raises(InvalidParameter, match=name):
        Settings(**{name: value})


def test_a_frame_is_needed():
    with pytest.raises(InvalidParameter, match="global_frame"):
        Wiring(global_frame="")


@pytest.mark.parametrize(
    ("robot", "kind", "guide"),
    [
        ("point", pf.PointRobot, "mpt"),
        ("dubins", pf.DubinsCar, "mpt-dubins"),
        ("reeds_shepp", pf.ReedsSheppCar, "mpt-dubins"),
    ],
)
def test_robots(robot, kind, guide):
    settings = Settings(robot=robot, turning_radius=0.7)
    made = settings.make_robot()
    assert type(made) is kind
    assert made.radius == 0.0
    assert getattr(made, "turning_radius", 0.7) == 0.7
    assert settings.guide_name == guide
    settings.check_names()


def test_guides():
    assert Settings(guide="none").guide_name is None
    assert Settings(guide="unet").guide_name == "unet"
    with pytest.raises(UnknownGuide, match="valid"):
        Settings(guide="oracle").check_names()


def test_planner_ids():
    settings = Settings(planner="BITstar", planner_ids=("GridBased", "Fast"))
    assert settings.planner_for("") == "BITstar"
    assert settings.planner_for("GridBased") == settings.planner_for("Fast") == "BITstar"
    assert settings.planner_for("RRTConnect") == "RRTConnect"
    with pytest.raises(UnknownPlanner, match="GridBased, Fast, RRT"):
        settings.planner_for("Theta*")
    with pytest.raises(UnknownPlanner, match="'Theta"):
        Settings(planner="Theta*").check_names()
    with pytest.raises(UnknownPlanner, match="dubins"):
        Settings(robot="dubins", planner="PRMstar").check_names()


def test_the_recommended_planner():
    for robot in ("point", "dubins", "reeds_shepp"):
        settings = Settings(robot=robot)
        made = settings.make_robot()
        assert settings.planner_for("GridBased") == pf.default_planner(made)
        unguided = dataclasses.replace(settings, guide="none").planner_for("")
        assert unguided == pf.default_planner(made, guided=False)


def test_what_means_none():
    assert Settings().optional_threshold is None
    assert Settings(threshold=0.0).optional_threshold == 0.0
    assert Settings().optional_seed is None
    assert Settings(seed=0).optional_seed == 0
