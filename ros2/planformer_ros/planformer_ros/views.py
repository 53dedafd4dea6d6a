"""What RViz shows: the last region and the last path."""

from __future__ import annotations

import numpy as np
from nav_msgs.msg import OccupancyGrid, Path
from numpy.typing import NDArray
from planformer.maps import Costmap
from rclpy.lifecycle import LifecycleNode
from std_msgs.msg import Header

from planformer_ros.messages import region_message
from planformer_ros.qos import LATCHED


class Views:
    """Latched topics of a node.

    Args:
        node: The node that they belong to.
    """

    def __init__(self, node: LifecycleNode) -> None:
        self._node = node
        self._region = node.create_lifecycle_publisher(OccupancyGrid, "~/region", LATCHED)
        self._path = node.create_lifecycle_publisher(Path, "~/path", LATCHED)

    def show_region(self, mask: NDArray[np.bool_], costmap: Costmap, header: Header) -> None:
        """Publish a region of a costmap."""
        self._region.publish(region_message(mask, costmap, header))

    def show_path(self, path: Path) -> None:
        """Publish a path."""
        self._path.publish(path)

    def destroy(self) -> None:
        """Take the topics away."""
        for publisher in (self._region, self._path):
            self._node.destroy_lifecycle_publisher(publisher)
