"""Between messages and arrays, and the same messages as rosbags reads and writes them."""

from __future__ import annotations

import array
import math
from pathlib import Path

import numpy as np
import planformer as pf
import pytest
from geometry_msgs.msg import Pose
from map_msgs.msg import OccupancyGridUpdate
from nav2_msgs.action import ComputePathToPose
from nav_msgs.msg import OccupancyGrid
from nav_msgs.msg import Path as PathMessage
from planformer.errors import InvalidMap
from planformer.maps import Costmap
from planformer_msgs.srv import ProposeRegion
from rclpy.serialization import deserialize_message, serialize_message
from rosbags.rosbag2 import Reader, Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from std_msgs.msg import Header

from planformer_ros import messages


@pytest.fixture(scope="module")
def costmap() -> Costmap:
    """480 x 480 cells, all costs, in a place of their own."""
    costs = np.random.default_rng(0).integers(0, 256, (480, 480), np.uint8)
    return Costmap(costs, 0.05, (-3.0, 2.0, 0.5))


def published(costmap: Costmap, values=None) -> OccupancyGrid:
    message = OccupancyGrid(info=messages.metadata_of(costmap))
    message.header.frame_id = "map"
    data = costmap.to_published() if values is None else np.asarray(values, np.int8)
    message.data = array.array("b", data.tobytes())
    return message


def request_of(costmap: Costmap) -> ProposeRegion.Request:
    request = ProposeRegion.Request(info=messages.metadata_of(costmap))
    request.header.frame_id = "map"
    request.costs = array.array("B", costmap.costs.tobytes())
    return request


def over_the_wire(message):
    return deserialize_message(serialize_message(message), type(message))


def test_costs_there_and_back(costmap):
    again = messages.costmap_of_request(over_the_wire(request_of(costmap)))
    np.testing.assert_array_equal(again.costs, costmap.costs)
    assert again.resolution == 0.05  # not 0.0500000007
    assert again.origin == pytest.approx(costmap.origin)


def test_a_published_costmap(costmap):
    again = messages.costmap_of_published(over_the_wire(published(costmap)))
    assert again.to_published().tolist() == costmap.to_published().tolist()
    np.testing.assert_array_equal(again.closed, costmap.closed)


def test_a_plain_map():
    grid = pf.generate_indoor(seed=1)
    message = published(Costmap.from_grid(grid), grid.to_ros())
    again = messages.costmap_of_map(over_the_wire(message))
    np.testing.assert_array_equal(again.grid.occupied, grid.occupied)
    np.testing.assert_array_equal(again.grid.unknown, grid.unknown)


def test_an_update(costmap):
    part = Costmap(costmap.costs[10:13, 20:25])
    message = OccupancyGridUpdate(x=20, y=10, width=5, height=3)
    message.data = array.array("b", part.to_published().tobytes())
    patch = messages.patch_of(over_the_wire(message))
    np.testing.assert_array_equal(patch >= 253, part.closed)
    message.width = 6
    with pytest.raises(InvalidMap, match="width"):
        messages.patch_of(message)


def test_a_path():
    poses = np.array([[0.0, 1.0, -3.0], [1.0, 2.0, 0.0], [2.0, 3.0, math.pi]])
    message = over_the_wire(messages.path_message(poses, Header(frame_id="map")))
    again = [messages.pose_of(pose.pose) for pose in message.poses]
    np.testing.assert_allclose(again, poses)


def test_a_region(costmap):
    mask = costmap.costs > 100
    message = over_the_wire(messages.region_message(mask, costmap, Header(frame_id="map")))
    np.testing.assert_array_equal(np.asarray(message.data) == 100, mask.ravel())
    assert messages.mask_values(mask).tolist() == mask.ravel().astype(int).tolist()


@pytest.mark.parametrize("seconds", [0.0, 0.25, 1.999999999, 61.5])
def test_durations(seconds):
    message = messages.duration_of(seconds)
    assert message.sec + 1e-9 * message.nanosec == pytest.approx(seconds)


class TestBadMessages:
    def test_empty(self):
        for read in (messages.costmap_of_map, messages.costmap_of_published):
            with pytest.raises(InvalidMap, match="width"):
                read(OccupancyGrid())
        with pytest.raises(InvalidMap, match="width"):
            messages.costmap_of_request(ProposeRegion.Request())

    def test_a_size_that_is_not_that_of_the_data(self, costmap):
        request = request_of(costmap)
        request.info.width = 2**31
        with pytest.raises(InvalidMap, match="needs width"):
            messages.costmap_of_request(request)

    @pytest.mark.parametrize("resolution", [0.0, -1.0, math.nan, math.inf])
    def test_resolution(self, costmap, resolution):
        request = request_of(costmap)
        request.info.resolution = resolution
        with pytest.raises(InvalidMap, match="resolution"):
            messages.costmap_of_request(request)

    def test_origin(self, costmap):
        request = request_of(costmap)
        request.info.origin.position.x = math.nan
        with pytest.raises(InvalidMap, match="origin"):
            messages.costmap_of_request(request)
        request.info.origin = Pose()
        request.info.origin.orientation.w = 0.0
        with pytest.raises(InvalidMap, match="origin"):
            messages.costmap_of_request(request)

    def test_values(self, costmap):
        message = published(costmap, np.full(480 * 480, 101))
        for read in (messages.costmap_of_map, messages.costmap_of_published):
            with pytest.raises(InvalidMap, match="100"):
                read(message)


class TestRosbags:
    """An implementation of its own reads and writes the same bytes."""

    @pytest.fixture
    def store(self, request):
        store = get_typestore(Stores.ROS2_KILTED)
        package = request.config.rootpath.parent / "planformer_msgs"
        parts = (package / "srv" / "ProposeRegion.srv").read_text().split("---")
        for part, text in zip(("Request", "Response"), parts, strict=True):
            store.register(get_types_from_msg(text, f"planformer_msgs/msg/ProposeRegion_{part}"))
        return store

    @pytest.mark.parametrize("name", ["map", "path", "request", "response"])
    def test_the_same_bytes(self, store, costmap, name):
        poses = np.random.default_rng(1).normal(size=(200, 3))
        response = ProposeRegion.Response(error_msg="ü", seconds=0.5, error_code=207)
        response.mask = messages.mask_values(costmap.closed)
        message, kind = {
            "map": (published(costmap), "nav_msgs/msg/OccupancyGrid"),
            "path": (
                messages.path_message(poses, Header(frame_id="map")),
                "nav_msgs/msg/Path",
            ),
            "request": (request_of(costmap), "planformer_msgs/msg/ProposeRegion_Request"),
            "response": (response, "planformer_msgs/msg/ProposeRegion_Response"),
        }[name]
        ours = serialize_message(message)
        theirs = store.deserialize_cdr(ours, kind)
        back = deserialize_message(bytes(store.serialize_cdr(theirs, kind)), type(message))
        # Both have been on the wire: a resolution is a 32-bit number there.
        assert back == deserialize_message(ours, type(message))

    def test_a_recorded_map_is_planned_on(self, store, tmp_path):
        grid = pf.generate_forest(seed=1)
        bag = Path(tmp_path, "bag")
        kind = "nav_msgs/msg/OccupancyGrid"
        with Writer(bag, version=9) as writer:
            connection = writer.add_connection("/map", kind, typestore=store)
            message = published(Costmap.from_grid(grid), grid.to_ros())
            writer.write(connection, 0, serialize_message(message))
        with Reader(bag) as reader:
            ((_, _, data),) = reader.messages()
        theirs = store.deserialize_cdr(data, kind)
        world = messages.costmap_of_map(theirs)
        np.testing.assert_array_equal(world.grid.occupied, grid.occupied)
        region = pf.propose_region(world.grid, pf.PointRobot(0.2), (1.0, 1.0), (23.0, 23.0))
        assert region.connected


def test_the_action_there_and_back():
    result = ComputePathToPose.Result(error_code=208, error_msg="none")
    result.path = PathMessage(header=Header(frame_id="map"))
    assert over_the_wire(result) == result
