"""Subscriptions to maps, costmaps and their updates."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from map_msgs.msg import OccupancyGridUpdate
from nav_msgs.msg import OccupancyGrid
from planformer.errors import InvalidMap, PlanformerError
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.node import Node
from rclpy.qos import QoSProfile
from std_msgs.msg import Header

from planformer_ros.messages import costmap_of_map, costmap_of_published, patch_of
from planformer_ros.qos import LATCHED, LATEST, UPDATES
from planformer_ros.settings import Wiring
from planformer_ros.world import World


class MapInputs:
    """Keeps the world up to date.

    Args:
        node: The node that they belong to.
        wiring: Topics and the frame that maps have to be in.
        world: Gets the maps.
    """

    def __init__(self, node: Node, wiring: Wiring, world: World) -> None:
        self._node, self._wiring, self._world = node, wiring, world
        self._costmap_time = (0, 0)
        wanted: list[tuple[type, str, Callable[[Any], None], QoSProfile]] = []
        if wiring.map_topic:
            qos = LATCHED if wiring.map_subscribe_transient_local else LATEST
            wanted.append((OccupancyGrid, wiring.map_topic, self._on_map, qos))
        if wiring.costmap_topic:
            updates = f"{wiring.costmap_topic}_updates"
            wanted.append((OccupancyGrid, wiring.costmap_topic, self._on_costmap, LATCHED))
            wanted.append((OccupancyGridUpdate, updates, self._on_update, UPDATES))
        group = MutuallyExclusiveCallbackGroup()  # no update overtakes another
        self._subscriptions = [
            node.create_subscription(kind, topic, callback, qos, callback_group=group)
            for kind, topic, callback, qos in wanted
        ]

    def destroy(self) -> None:
        """End the subscriptions."""
        for subscription in self._subscriptions:
            self._node.destroy_subscription(subscription)

    def _on_map(self, message: OccupancyGrid) -> None:
        self._take(message.header, lambda: self._world.set_map(costmap_of_map(message)))

    def _on_costmap(self, message: OccupancyGrid) -> None:
        def take() -> None:
            self._world.set_costmap(costmap_of_published(message))
            self._costmap_time = _time_of(message.header)

        self._take(message.header, take)

    def _on_update(self, message: OccupancyGridUpdate) -> None:
        if _time_of(message.header) < self._costmap_time:
            return  # a latched one of before: the costmap knows better
        self._take(
            message.header,
            lambda: self._world.update_costmap(patch_of(message), message.x, message.y),
        )

    def _take(self, header: Header, take: Callable[[], None]) -> None:
        """Take a map; what is none is reported and leaves the last one in place."""
        frame = self._wiring.global_frame
        try:
            if header.frame_id != frame:
                raise InvalidMap(f"its frame is {header.frame_id!r}, global_frame is {frame!r}")
            take()
        except PlanformerError as error:
            self._node.get_logger().warning(f"a map is ignored: {error}")


def _time_of(header: Header) -> tuple[int, int]:
    return header.stamp.sec, header.stamp.nanosec
