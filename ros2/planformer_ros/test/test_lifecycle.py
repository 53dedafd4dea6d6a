"""Transitions, parameters and how the program starts and ends."""

from __future__ import annotations

import signal

import numpy as np
import pytest
import yaml
from lifecycle_msgs.srv import GetState
from planformer.maps import Costmap

from client import (
    ABORTED,
    ACTIVATE,
    ACTIVE_SHUTDOWN,
    CLEANUP,
    CONFIGURE,
    DEACTIVATE,
    PATIENCE,
    SHUTDOWN,
    SUCCEEDED,
    Planner,
    make_goal,
    until,
)
from planformer_ros.error_codes import ErrorCode

START, GOAL = (1.0, 1.0, 0.0), (3.0, 3.0, 1.0)


def world() -> Costmap:
    """A room with a pillar in the way: a straight path, which nothing improves, ends the search."""
    costs = np.zeros((100, 100), np.uint8)
    costs[35:45, 35:45] = 254
    return Costmap(costs)


def test_all_transitions(client, tmp_path):
    with Planner(tmp_path, time_limit=60.0):
        assert client.state() == "unconfigured"
        assert not client.change_state(ACTIVATE)
        for _ in range(2):
            assert client.change_state(CONFIGURE)
            assert client.state() == "inactive"
            assert client.region(world(), START, GOAL).error_code == ErrorCode.UNKNOWN
            assert not client.send(make_goal(START, GOAL)).accepted
            assert client.change_state(ACTIVATE)
            assert client.region(world(), START, GOAL).error_code == 0
            client.publish_costmap(world())
            handle = long_goal(client)
            assert client.change_state(DEACTIVATE)
            assert client.result(handle)[0] == ABORTED
            assert not client.send(make_goal(START, GOAL)).accepted
            assert client.change_state(CLEANUP)
            assert client.state() == "unconfigured"
        assert client.change_state(CONFIGURE)
        assert client.change_state(SHUTDOWN)
        assert client.state() == "finalized"


def long_goal(client):
    """The handle of a goal that is planned for as long as the planner may."""
    until(lambda: client.plan(START, GOAL, planner_id="RRTConnect")[0] == SUCCEEDED)
    return client.send(make_goal(START, GOAL, planner_id="RRTstar"))


def test_goals_end_before_the_action_is_taken_away(client, planner):
    client.publish_costmap(world())
    for _ in range(5):
        result = long_goal(client).get_result_async()  # asked for at once, as Nav2's trees do
        for transition in (DEACTIVATE, CLEANUP):
            assert client.change_state(transition)
        assert client.wait(result).status == ABORTED
        for transition in (CONFIGURE, ACTIVATE):
            assert client.change_state(transition)


def test_a_shutdown_ends_the_goal_in_progress(client, planner):
    client.publish_costmap(world())
    result = long_goal(client).get_result_async()
    assert client.change_state(ACTIVE_SHUTDOWN)
    assert client.wait(result).status == ABORTED
    assert client.state() == "finalized"
    assert client.region(world(), START, GOAL).error_code == ErrorCode.UNKNOWN


def test_a_configuration_that_cannot_work_fails_and_can_be_repaired(client, tmp_path):
    with Planner(tmp_path, guide="oracle") as planner:
        assert not client.change_state(CONFIGURE)
        assert client.state() == "unconfigured"
        assert "unknown guide 'oracle'" in planner.log
        assert client.set_parameter("guide", "mpt") is None
        assert client.change_state(CONFIGURE)


@pytest.mark.parametrize(
    ("name", "value", "reason"),
    [
        ("robot", "tank", "point, dubins, reeds_shepp"),
        ("planner", "Theta*", "unknown planner"),
        ("guide", "oracle", "unknown guide"),
        ("threshold", -0.5, "threshold"),
        ("time_limit", 0.0, "range"),
        ("exploration", 7.0, "range"),
        ("map_topic", "other", "read-only"),
    ],
)
def test_parameters_that_are_refused(client, planner, name, value, reason):
    assert reason in client.set_parameter(name, value)
    assert client.region(world(), START, GOAL).error_code == 0  # and it goes on


def test_parameters_change_together_or_not_at_all(client, planner):
    assert client.set_parameter("planner", "PRMstar") is None
    assert "unknown planner 'PRMstar'" in client.set_parameter("robot", "dubins")
    assert client.set_parameter("planner", "auto") is None
    assert client.set_parameter("robot", "dubins") is None
    assert client.set_parameter("robot", "point") is None


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ({"robot": "tank"}, "must be one of point, dubins, reeds_shepp"),
        ({"time_limit": -1.0}, "time_limit"),
        ({"robot_radius": "wide"}, "robot_radius"),
        ({"map_topic": "no topic"}, "no topic"),
        ({"costmap_topic": "no//topic"}, "no//topic"),
        ({"guide": "oracle", "autostart": True}, "unknown guide 'oracle'"),
    ],
)
def test_a_start_with_bad_parameters_ends_with_a_message(tmp_path, parameters, message):
    planner = Planner(tmp_path, **parameters)
    assert planner.process.wait(PATIENCE) == 1, planner.log
    assert message in planner.log
    assert "Traceback" not in planner.log


def test_it_ends_at_once_while_it_plans(client, tmp_path):
    with Planner(tmp_path, autostart=True, time_limit=600.0) as planner:
        client.publish_costmap(world())
        long_goal(client)
        planner.process.send_signal(signal.SIGINT)
        assert planner.process.wait(PATIENCE) == 0  # not after ten minutes


@pytest.mark.parametrize("name", ["planformer", "region_server"])
def test_the_examples_work(client, tmp_path, pytestconfig, name):
    file = pytestconfig.rootpath / "config" / f"{name}.yaml"
    with Planner(tmp_path, file):
        assert client.region(world(), START, GOAL).error_code == 0
        if name == "planformer":
            client.publish_map(world())
            until(lambda: client.plan(START, GOAL, planner_id="GridBased")[0] == SUCCEEDED)


def test_the_examples_count_in_a_namespace(client, tmp_path, pytestconfig):
    file = pytestconfig.rootpath / "config" / "planformer.yaml"
    with Planner(tmp_path, file, namespace="robot1") as planner:
        until(lambda: client.node.count_services("/robot1/propose_region") == 1)
        state = client.call(GetState, "/robot1/planformer/get_state", GetState.Request())
        assert state.current_state.label == "active", planner.log  # by the file's autostart


def test_the_example_names_all_parameters(pytestconfig):
    from dataclasses import fields

    from planformer_ros.settings import Settings, Wiring

    text = (pytestconfig.rootpath / "config" / "planformer.yaml").read_text()
    given = yaml.safe_load(text)["/**/planformer"]["ros__parameters"]
    names = {item.name for kind in (Settings, Wiring) for item in fields(kind)}
    assert set(given) <= names
    assert names - set(given) == {"seed", "max_pixels"}  # for few


def test_launch_file_and_view_can_be_read(pytestconfig):
    launch = pytestconfig.rootpath / "launch" / "planformer.launch.py"
    compile(launch.read_text(), str(launch), "exec")
    view = yaml.safe_load((pytestconfig.rootpath / "rviz" / "planformer.rviz").read_text())
    topics = {
        display["Topic"]["Value"]
        for display in view["Visualization Manager"]["Displays"]
        if "Topic" in display
    }
    assert {"/map", "/planformer/region", "/planformer/path"} <= topics
