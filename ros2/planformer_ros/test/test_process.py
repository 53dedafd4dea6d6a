"""The planner in one process, its client in this one."""

from __future__ import annotations

import array
import math
import time

import numpy as np
import planformer as pf
import pytest
from nav_msgs.msg import OccupancyGrid, Path
from planformer.maps import Costmap
from planformer.maps.costmap import inflated, with_patch
from planformer_msgs.srv import ProposeRegion

from client import ABORTED, CANCELED, PATIENCE, SUCCEEDED, make_goal, poses_of, set_pose, until
from planformer_ros.error_codes import ErrorCode
from planformer_ros.messages import metadata_of

pytestmark = pytest.mark.usefixtures("planner")

RADIUS = 0.22  # robot_radius of the planner
START, GOAL = (1.0, 1.0, 0.0), (23.0, 23.0, 1.0)


def forest() -> Costmap:
    """480 x 480 cells."""
    return Costmap.from_grid(pf.generate_forest(seed=1))


def check_path(path, costmap: Costmap, radius: float, start, goal) -> None:
    """The path is what Nav2 may hand to a controller."""
    poses = poses_of(path)
    assert pf.path_is_valid(costmap.grid, pf.PointRobot(radius), poses[:, :2])
    np.testing.assert_allclose(poses[0, :2], start[:2], atol=1e-9)
    np.testing.assert_allclose(poses[-1], goal, atol=1e-6)
    assert np.hypot(*np.diff(poses[:, :2], axis=0).T).max() <= 0.05 + 1e-9
    assert {pose.header.frame_id for pose in path.poses} == {path.header.frame_id} == {"map"}


@pytest.fixture
def quick(client):
    """The client of a planner that has little time."""
    assert client.set_parameter("time_limit", 3.0) is None
    yield client
    assert client.set_parameter("time_limit", 60.0) is None


def test_a_path_on_nav2s_depot(quick, maps):
    costmap = Costmap.from_grid(pf.load_map(maps / "depot.yaml"))
    quick.publish_map(costmap)
    start, goal = (2.0, 2.0, 0.0), (25.0, 12.0, 1.57)
    status, result = plan_on(quick, costmap, start, goal)
    assert (status, result.error_code, result.error_msg) == (SUCCEEDED, 0, "")
    check_path(result.path, costmap, RADIUS, start, goal)
    assert result.planning_time.sec < 60


def test_a_region_of_nav2s_depot(client, maps):
    plain = Costmap.from_grid(pf.load_map(maps / "depot.yaml"))
    costmap = inflated(plain, RADIUS)
    start, goal = (2.0, 2.0, 0.0), (25.0, 12.0, 1.57)
    answer = client.region(costmap, start, goal)
    assert (answer.error_code, answer.error_msg) == (0, "")
    expected = pf.propose_region(costmap.grid, pf.PointRobot(0.0), start[:2], goal[:2])
    np.testing.assert_array_equal(answer.mask, expected.mask.ravel())
    assert 0.0 < answer.seconds < PATIENCE


def test_what_rviz_shows(quick):
    costmap = forest()
    quick.publish_map(costmap)
    status, result = plan_on(quick, costmap, START, GOAL)
    assert status == SUCCEEDED
    assert quick.latest(Path, "/planformer/path") == result.path
    region = quick.latest(OccupancyGrid, "/planformer/region")
    assert (region.info.width, region.info.height, region.header.frame_id) == (480, 480, "map")
    assert region.info.resolution == pytest.approx(0.05)
    assert set(region.data) == {0, 100}


def test_a_costmap_replaces_the_map_and_is_not_inflated_again(quick):
    costs = np.zeros((100, 100), np.uint8)
    costs[:, 48:52] = 254
    costs[20:23, 48:52] = 0  # a gap of 0.15 m, too narrow for a robot on a plain map
    costmap = Costmap(costs)
    start, goal = (1.0, 4.0, 0.0), (4.0, 4.0, 0.0)
    quick.publish_map(costmap)
    status, result = plan_on(quick, costmap, start, goal, wanted=ErrorCode.NO_VALID_PATH)
    assert (status, result.error_code) == (ABORTED, ErrorCode.NO_VALID_PATH)
    quick.publish_costmap(costmap)
    status, result = plan_on(quick, costmap, start, goal)
    assert (status, result.error_code) == (SUCCEEDED, 0)
    check_path(result.path, costmap, 0.0, start, goal)


def plan_on(client, costmap: Costmap, start, goal, wanted: int = 0):
    """Plan until the planner has received the map that was just published."""
    answers = []

    def is_as_wanted() -> bool:
        answers.append(client.plan(start, goal))
        return answers[-1][1].error_code == wanted

    until(is_as_wanted)
    return answers[-1]


@pytest.fixture
def hard(client):
    """The client of a planner that has to think long: it improves its path for a minute."""
    client.publish_costmap(forest())
    until(lambda: client.region(forest(), START, GOAL).error_code == 0)
    return client


class TestGoalsInProgress:
    def test_cancel(self, hard):
        handle = hard.send(make_goal(START, GOAL))
        assert len(hard.cancel(handle)) == 1
        status, result = hard.result(handle)
        assert (status, len(result.path.poses)) == (CANCELED, 0)

    def test_cancel_many_times(self, hard):
        for _ in range(20):
            handle = hard.send(make_goal(START, GOAL))
            hard.cancel(handle)
            assert hard.result(handle)[0] == CANCELED

    def test_a_newer_goal_replaces_an_older_one(self, hard):
        handles = [hard.send(make_goal(START, GOAL)) for _ in range(5)]
        for handle in handles[:-1]:
            status, result = hard.result(handle)
            assert (status, len(result.path.poses)) == (ABORTED, 0)
        hard.cancel(handles[-1])
        assert hard.result(handles[-1])[0] == CANCELED

    def test_it_answers_while_it_plans(self, hard):
        handle = hard.send(make_goal(START, GOAL))
        assert hard.state() == "active"
        assert hard.region(forest(), START, GOAL).error_code == 0
        assert hard.set_parameter("seed", 3) is None
        hard.cancel(handle)
        assert hard.result(handle)[0] == CANCELED
        assert hard.set_parameter("seed", -1) is None

    def test_the_time_limit_counts(self, hard):
        assert hard.set_parameter("time_limit", 0.5) is None
        status, result = hard.plan(START, GOAL)
        assert hard.set_parameter("time_limit", 60.0) is None
        assert status == SUCCEEDED
        assert result.planning_time.sec < 60  # not the limit of before

    def test_too_short_a_time(self, hard):
        assert hard.set_parameter("time_limit", 0.01) is None
        status, result = hard.plan(START, GOAL, planner_id="PRMstar")
        assert hard.set_parameter("time_limit", 60.0) is None
        assert (status, result.error_code) == (ABORTED, ErrorCode.TIMEOUT)


class TestMapsThatChange:
    def world(self) -> Costmap:
        """Two rooms with two doors in the wall between them."""
        costs = np.zeros((200, 200), np.uint8)
        costs[:, 98:102] = 254
        costs[95:105, 98:102] = 0  # the near door
        costs[180:190, 98:102] = 0  # the far one
        return Costmap(costs)

    def closed(self) -> Costmap:
        """What lies over the near door."""
        return Costmap(np.full((10, 4), 254, np.uint8))

    @pytest.mark.parametrize("as_update", [True, False])
    def test_a_door_that_closes_while_it_plans(self, client, as_update):
        # Not straight through the door: such a path, which nothing improves, ends the search.
        start, goal = (1.0, 3.0, 0.0), (9.0, 3.0, 0.0)
        world = self.world()
        later = with_patch(world, self.closed().costs, 98, 95)
        client.set_parameter("time_limit", 3.0)

        def goes_through_the_far_door() -> bool:
            client.publish_costmap(world)
            until(lambda: ends_in(client, start, goal, world))
            handle = client.send(make_goal(start, goal))
            time.sleep(0.2)  # it plans on the first map by now
            if as_update:
                client.publish_update(self.closed(), 98, 95)
            else:
                client.publish_costmap(later)
            poses = poses_of(client.result(handle)[1].path)[:, :2]
            return len(poses) > 0 and pf.path_is_valid(later.grid, pf.PointRobot(0.0), poses)

        # On a busy machine the map may come too late, or the rest of the time be too short.
        assert any(goes_through_the_far_door() for _ in range(5))

    def test_a_costmap_knows_better_than_an_update_of_before(self, quick, planner):
        start, goal = (1.0, 5.0, 0.0), (9.0, 5.0, 0.0)
        one_door = with_patch(self.world(), np.full((10, 4), 254, np.uint8), 98, 180)
        quick.publish_costmap(one_door, time=10)
        until(lambda: ends_in(quick, start, goal, one_door))
        quick.publish_update(self.closed(), 98, 95, time=9)
        quick.publish_update(self.closed(), 199, 199, time=11)  # comes next and is reported
        until(lambda: "a map is ignored" in planner.log)
        assert quick.plan(start, goal)[0] == SUCCEEDED
        quick.publish_update(self.closed(), 98, 95, time=11)
        until(lambda: quick.plan(start, goal)[1].error_code == ErrorCode.NO_VALID_PATH)

    def test_a_damaged_map_leaves_the_last_one(self, quick, planner):
        world = self.world()
        quick.publish_costmap(world)
        start, goal = (1.0, 5.0, 0.0), (9.0, 5.0, 0.0)
        until(lambda: ends_in(quick, start, goal, world))
        quick.publish_costmap(world, frame="odom")
        quick.publish_map(world, values=np.zeros(7))
        quick.publish_update(self.closed(), 199, 199)
        until(lambda: planner.log.count("a map is ignored") >= 3)
        assert "its frame is 'odom'" in planner.log
        assert quick.plan(start, goal)[0] == SUCCEEDED


def ends_in(client, start, goal, costmap: Costmap) -> bool:
    """Whether a path for a costmap is found: it has arrived."""
    _, result = client.plan(start, goal, planner_id="RRTConnect")
    poses = poses_of(result.path)[:, :2]
    return len(poses) > 0 and pf.path_is_valid(costmap.grid, pf.PointRobot(0.0), poses)


class TestBadRequests:
    """Each has Nav2's code and no mask, and the planner goes on."""

    def good(self) -> ProposeRegion.Request:
        request = ProposeRegion.Request(info=metadata_of(Costmap([[0] * 100] * 100)))
        request.costs = array.array("B", bytes(100 * 100))
        set_pose(request.start, (1.0, 1.0))
        set_pose(request.goal, (3.0, 3.0))
        return request

    def test_requests(self, client):
        def damaged(change) -> ProposeRegion.Request:
            request = self.good()
            change(request)
            return request

        unknown, no_planner = ErrorCode.UNKNOWN, ErrorCode.INVALID_PLANNER
        for request, code in (
            (ProposeRegion.Request(), unknown),
            (damaged(lambda bad: setattr(bad.info, "height", 99)), unknown),
            (damaged(lambda bad: setattr(bad.info, "width", 2**32 - 1)), unknown),
            (damaged(lambda bad: setattr(bad.info, "resolution", 1e6)), unknown),
            (damaged(lambda bad: setattr(bad.info, "resolution", math.nan)), unknown),
            (damaged(lambda bad: setattr(bad.info.origin.position, "x", math.inf)), unknown),
            (damaged(lambda bad: setattr(bad.goal.orientation, "w", math.nan)), unknown),
            (damaged(lambda bad: setattr(bad, "guide", "oracle")), no_planner),
            (damaged(lambda bad: setattr(bad, "guide", "/absent.onnx")), no_planner),
        ):
            answer = client.ask(request)
            assert (answer.error_code, len(answer.mask)) == (code, 0), request.info
            assert answer.error_msg
        answer = client.ask(self.good())
        assert (answer.error_code, len(answer.mask)) == (0, 100 * 100)


class TestBadGoals:
    """Each has Nav2's code, and the planner goes on."""

    def world(self) -> Costmap:
        costs = np.zeros((100, 100), np.uint8)
        costs[:, 60:62] = 254
        costs[80:, :20] = 255
        costs[:20, 58:60] = 253
        return Costmap(costs)

    @pytest.mark.parametrize(
        ("start", "goal", "code"),
        [
            ((1.0, 1.0), (4.0, 1.0), ErrorCode.NO_VALID_PATH),
            ((-1.0, 1.0), (2.0, 1.0), ErrorCode.START_OUTSIDE_MAP),
            ((math.nan, 1.0), (2.0, 1.0), ErrorCode.START_OUTSIDE_MAP),
            ((1.0, 1.0), (99.0, 1.0), ErrorCode.GOAL_OUTSIDE_MAP),
            ((1.0, 1.0), (1.0, math.inf), ErrorCode.GOAL_OUTSIDE_MAP),
            ((3.05, 1.0), (2.0, 1.0), ErrorCode.START_OCCUPIED),
            ((0.5, 4.5), (2.0, 1.0), ErrorCode.START_OCCUPIED),
            ((1.0, 1.0), (3.05, 1.0), ErrorCode.GOAL_OCCUPIED),
            ((1.0, 1.0), (0.5, 4.5), ErrorCode.GOAL_OCCUPIED),
            ((1.0, 1.0), (2.95, 0.5), ErrorCode.GOAL_OCCUPIED),
            ((1.0, 1.0), (2.0, 1.0, math.nan), ErrorCode.UNKNOWN),
        ],
    )
    def test_states(self, client, start, goal, code):
        client.publish_costmap(self.world())
        status, result = plan_on(client, self.world(), start, goal, wanted=code)
        assert (status, result.error_code) == (ABORTED, code)
        assert result.error_msg
        assert len(result.path.poses) == 0
        assert client.region(self.world(), start, goal).error_code == code

    def test_a_start_in_the_inscribed_zone_can_leave(self, quick):
        quick.publish_costmap(self.world())
        status, _ = plan_on(quick, self.world(), (2.95, 0.5), (1.0, 1.0, 0.0))
        assert status == SUCCEEDED

    def test_names(self, client):
        status, result = client.plan(START, GOAL, planner_id="Theta*")
        assert (status, result.error_code) == (ABORTED, ErrorCode.INVALID_PLANNER)
        assert "GridBased" in result.error_msg

    @pytest.mark.parametrize(
        "fields",
        [
            {"frame": "mars"},
            {"start_frame": "odom"},
            {"frame": ""},
            {"use_start": False},
        ],
    )
    def test_frames_without_tf2(self, client, fields):
        status, result = client.plan(START, GOAL, **fields)
        assert (status, result.error_code) == (ABORTED, ErrorCode.TF_ERROR)
        assert "tf2_ros is not installed" in result.error_msg
