"""Goals in other frames and from where the robot stands; see stand_ins/tf2_ros."""

from __future__ import annotations

import math

import numpy as np
import pytest
from geometry_msgs.msg import TransformStamped
from planformer.maps import Costmap
from tf2_msgs.msg import TFMessage

from client import (
    ABORTED,
    ACTIVATE,
    CANCELED,
    CLEANUP,
    CONFIGURE,
    DEACTIVATE,
    SUCCEEDED,
    Planner,
    make_goal,
    poses_of,
    until,
)
from planformer_ros.error_codes import ErrorCode
from planformer_ros.qos import LATCHED

START, GOAL = (1.0, 1.0, 0.0), (3.0, 3.0, 1.0)
ODOMETRY = ("map", "odom", (1.0, 1.0, math.pi / 2))
ROBOT = ("odom", "base_link", (1.0, 0.0, 0.5))


@pytest.fixture
def planner(tmp_path):
    """The planner where tf2_ros is installed, with a map."""
    parameters = {"time_limit": 60.0, "transform_timeout": 60.0, "planner": "RRTConnect"}
    with Planner(tmp_path, with_tf2=True, autostart=True, **parameters) as planner:
        yield planner


@pytest.fixture
def with_map(client, planner):
    costs = np.zeros((100, 100), np.uint8)
    costs[35:45, 35:45] = 254  # a straight path, which nothing improves, would end the search
    client.publish_costmap(Costmap(costs))
    until(lambda: client.plan(START, GOAL)[0] == SUCCEEDED)
    return client


@pytest.fixture
def transforms(client):
    """Publishes the places of frames in their parents."""
    publisher = client.node.create_publisher(TFMessage, "/tf_static", LATCHED)

    def publish(*places) -> None:
        message = TFMessage()
        for parent, child, (x, y, yaw) in places:
            stamped = TransformStamped(child_frame_id=child)
            stamped.header.frame_id = parent
            stamped.transform.translation.x, stamped.transform.translation.y = x, y
            stamped.transform.rotation.z = math.sin(yaw / 2)
            stamped.transform.rotation.w = math.cos(yaw / 2)
            message.transforms.append(stamped)
        publisher.publish(message)

    return publish


def test_from_where_the_robot_stands(with_map, transforms):
    transforms(ODOMETRY, ROBOT)
    status, result = with_map.plan(START, GOAL, use_start=False)
    assert (status, result.error_msg) == (SUCCEEDED, "")
    assert poses_of(result.path)[0, :2] == pytest.approx((1.0, 2.0))
    assert poses_of(result.path)[-1] == pytest.approx(GOAL)


def test_a_goal_in_another_frame(with_map, transforms):
    transforms(ODOMETRY)
    status, result = with_map.plan(START, (2.0, -1.0, 0.3), frame="odom")
    assert (status, result.error_msg) == (SUCCEEDED, "")
    assert result.path.header.frame_id == "map"
    assert poses_of(result.path)[-1] == pytest.approx((2.0, 3.0, 0.3 + math.pi / 2))


def test_a_transform_that_comes_while_it_is_waited_for(with_map, transforms):
    handle = with_map.send(make_goal(START, GOAL, use_start=False))
    transforms(ODOMETRY, ROBOT)
    assert with_map.result(handle)[0] == SUCCEEDED


def test_a_frame_that_nobody_knows(client, tmp_path):
    with Planner(tmp_path, with_tf2=True, autostart=True, transform_timeout=0.05):
        status, result = client.plan(START, GOAL, frame="mars")
    assert (status, result.error_code) == (ABORTED, ErrorCode.TF_ERROR)
    assert "mars" in result.error_msg


def test_it_answers_while_it_plans(with_map):
    handle = with_map.send(make_goal(START, GOAL, planner_id="RRTstar"))
    assert with_map.state() == "active"
    assert len(with_map.cancel(handle)) == 1
    assert with_map.result(handle)[0] == CANCELED


def test_it_stops_listening_when_it_is_cleaned_up(with_map, transforms):
    transforms(ODOMETRY, ROBOT)
    for _ in range(2):
        until(lambda: with_map.node.count_subscribers("/tf") == 1)
        assert with_map.plan(START, GOAL, use_start=False)[1].error_code != ErrorCode.TF_ERROR
        for transition in (DEACTIVATE, CLEANUP):
            assert with_map.change_state(transition)
        until(lambda: with_map.node.count_subscribers("/tf") == 0)
        for transition in (CONFIGURE, ACTIVATE):
            assert with_map.change_state(transition)
