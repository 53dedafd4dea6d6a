"""Between ROS messages and arrays.

Arrays pass through `array.array`: to anything else the setters of ROS messages look at every
element, which takes a hundred times as long.
"""

from __future__ import annotations

import array
import math

import numpy as np
from builtin_interfaces.msg import Duration
from geometry_msgs.msg import Pose as PoseMessage
from geometry_msgs.msg import PoseStamped
from map_msgs.msg import OccupancyGridUpdate
from nav_msgs.msg import MapMetaData, Path
from nav_msgs.msg import OccupancyGrid as OccupancyGridMessage
from numpy.typing import NDArray
from planformer import OccupancyGrid
from planformer.maps import Costmap
from planformer.maps.costmap import costs_from_published
from planformer_msgs.srv import ProposeRegion
from std_msgs.msg import Header

from planformer_ros.poses import yaw_of
from planformer_ros.problem import Pose


def pose_of(message: PoseMessage) -> Pose:
    """x, y [m] and yaw [rad] of a pose; the yaw is NaN where the quaternion is none."""
    q = message.orientation
    return message.position.x, message.position.y, yaw_of(q.x, q.y, q.z, q.w)


def costmap_of_map(message: OccupancyGridMessage) -> Costmap:
    """Read a plain map, as map_server and SLAM publish them.

    Raises:
        InvalidMap: The message is no map.
    """
    info = message.info
    values = np.asarray(message.data)
    grid = OccupancyGrid.from_ros(
        values, info.width, info.height, _resolution(info), pose_of(info.origin)
    )
    return Costmap.from_grid(grid)


def costmap_of_published(message: OccupancyGridMessage) -> Costmap:
    """Read a costmap, as Nav2's costmaps publish it.

    Raises:
        InvalidMap: The message is no costmap.
    """
    info = message.info
    values = np.asarray(message.data)
    return Costmap.from_published(
        values, info.width, info.height, _resolution(info), pose_of(info.origin)
    )


def costmap_of_request(request: ProposeRegion.Request) -> Costmap:
    """Read the costmap of a request for a region.

    Raises:
        InvalidMap: The request holds no costmap.
    """
    info = request.info
    values = np.asarray(request.costs)
    return Costmap.from_nav2(
        values, info.width, info.height, _resolution(info), pose_of(info.origin)
    )


def patch_of(message: OccupancyGridUpdate) -> NDArray[np.uint8]:
    """(h, w) costs of a costmap's update.

    Raises:
        InvalidMap: The message is no update.
    """
    costs = costs_from_published(np.asarray(message.data))
    return Costmap.from_nav2(costs, message.width, message.height, 1.0).costs


def region_message(
    mask: NDArray[np.bool_], costmap: Costmap, header: Header
) -> OccupancyGridMessage:
    """A region as a map: 100 inside, 0 outside."""
    message = OccupancyGridMessage(header=header, info=metadata_of(costmap))
    message.info.map_load_time = header.stamp
    message.data = array.array("b", np.where(mask, 100, 0).astype(np.int8).tobytes())
    return message


def metadata_of(costmap: Costmap) -> MapMetaData:
    """Size and place of a costmap."""
    height, width = costmap.costs.shape
    return MapMetaData(
        resolution=costmap.resolution, width=width, height=height, origin=_pose(costmap.origin)
    )


def path_message(poses: NDArray[np.float64], header: Header) -> Path:
    """A path of (N, 3) poses."""
    stamped = [PoseStamped(header=header, pose=_pose(pose)) for pose in poses.tolist()]
    return Path(header=header, poses=stamped)


def mask_values(mask: NDArray[np.bool_]) -> array.array[int]:
    """A region as 0 and 1, row by row."""
    return array.array("B", mask.tobytes())


def duration_of(seconds: float) -> Duration:
    """Seconds as a message."""
    whole, rest = divmod(round(seconds * 1e9), 10**9)
    return Duration(sec=whole, nanosec=rest)


def _pose(pose: Pose | list[float]) -> PoseMessage:
    x, y, yaw = pose
    message = PoseMessage()
    message.position.x, message.position.y = float(x), float(y)
    message.orientation.z = math.sin(0.5 * yaw)
    message.orientation.w = math.cos(0.5 * yaw)
    return message


def _resolution(info: MapMetaData) -> float:
    """The message has 32 bits, which make 0.05 m 0.0500000007 m."""
    return float(np.format_float_positional(np.float32(info.resolution)))
