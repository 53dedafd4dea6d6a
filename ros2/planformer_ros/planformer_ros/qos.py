"""Quality of service, as Nav2's."""

from __future__ import annotations

from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

LATCHED = QoSProfile(
    depth=1,
    durability=DurabilityPolicy.TRANSIENT_LOCAL,
    reliability=ReliabilityPolicy.RELIABLE,
)
"""Maps, costmaps, regions and paths: who comes late gets the last one."""

UPDATES = QoSProfile(
    depth=100,
    durability=DurabilityPolicy.TRANSIENT_LOCAL,
    reliability=ReliabilityPolicy.RELIABLE,
)
"""Updates of costmaps: each changes other cells, so that none may be dropped for a newer one."""

LATEST = QoSProfile(
    depth=1, durability=DurabilityPolicy.VOLATILE, reliability=ReliabilityPolicy.RELIABLE
)
"""Maps from those that send them again and again, and keep none."""
