"""Stands in for tf2_ros where ROS comes from PyPI: what the planner uses of it, in the plane.

Written anew from the documented interface. The rules that the planner could break are the real
ones: a wait for a transform blocks its thread, a listener receives on the node that it is given,
and a listener with a thread of its own takes that node away from the executor that it had.
"""

from __future__ import annotations

import cmath
import math
import threading
import time

from geometry_msgs.msg import TransformStamped
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.duration import Duration
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile
from tf2_msgs.msg import TFMessage

Place = tuple[str, complex, complex]
"""A frame, and in it a position and a unit vector for the heading."""


class TransformException(Exception):
    """A transform is not known."""


class Buffer:
    """Knows the latest place of each frame in its parent."""

    def __init__(self, cache_time=None, node=None) -> None:
        del cache_time, node  # the node would offer a service that shows all frames
        self._places: dict[str, Place] = {}

    def set_transform(self, transform: TransformStamped, authority: str) -> None:
        del authority
        move, turn = transform.transform.translation, transform.transform.rotation
        heading = cmath.exp(2j * math.atan2(turn.z, turn.w))
        place = transform.header.frame_id, complex(move.x, move.y), heading
        self._places[transform.child_frame_id] = place

    set_transform_static = set_transform

    def lookup_transform(self, target, source, when, timeout: Duration) -> TransformStamped:
        del when  # the latest
        deadline = time.monotonic() + timeout.nanoseconds / 1e9
        while self._root(target)[0] != self._root(source)[0]:
            if time.monotonic() >= deadline:
                raise TransformException(f"{target!r} and {source!r} are not connected")
            time.sleep(0.02)
        (_, base, turned), (_, position, heading) = self._root(target), self._root(source)
        found = TransformStamped(child_frame_id=source)
        found.header.frame_id = target
        move, turn = (position - base) / turned, cmath.phase(heading / turned)
        found.transform.translation.x, found.transform.translation.y = move.real, move.imag
        found.transform.rotation.z, found.transform.rotation.w = (
            math.sin(turn / 2),
            math.cos(turn / 2),
        )
        return found

    def _root(self, frame: str) -> Place:
        position, heading = 0j, 1 + 0j
        while frame in self._places:
            frame, base, turned = self._places[frame]
            position, heading = base + turned * position, turned * heading
        return frame, position, heading


class TransformListener:
    """Fills a buffer from the topics /tf and /tf_static."""

    def __init__(self, buffer, node, *, spin_thread: bool = False) -> None:
        static = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        group = ReentrantCallbackGroup()
        for topic, qos in (("/tf", QoSProfile(depth=100)), ("/tf_static", static)):
            node.create_subscription(TFMessage, topic, self._take, qos, callback_group=group)
        self._buffer = buffer
        if spin_thread:
            executor = SingleThreadedExecutor()
            executor.add_node(node)
            threading.Thread(target=executor.spin, daemon=True).start()

    def _take(self, message: TFMessage) -> None:
        for transform in message.transforms:
            self._buffer.set_transform(transform, "")
