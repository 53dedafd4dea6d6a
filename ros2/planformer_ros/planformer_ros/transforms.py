"""Poses in other frames, where tf2 is installed."""

from __future__ import annotations

import contextlib
import threading
from typing import Any, Protocol

import rclpy
from planformer.geometry import Frame
from rclpy.duration import Duration
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.time import Time

from planformer_ros.error_codes import TransformUnavailable
from planformer_ros.poses import yaw_of
from planformer_ros.problem import Pose


class Transforms(Protocol):
    """Knows where frames are."""

    def lookup(self, target: str, source: str) -> Frame:
        """The pose of the frame `source` in the frame `target`, in the plane.

        Raises:
            TransformUnavailable: It is not known.
        """
        ...

    def destroy(self) -> None:
        """Listen no more."""
        ...


class NoTransforms:
    """Knows nothing; ROS without tf2_ros."""

    def lookup(self, target: str, source: str) -> Frame:
        """Always fails and says what would help."""
        raise TransformUnavailable(
            f"the pose of {source} in {target} is not known, because tf2_ros is not installed; "
            "send goals in the frame of the map with use_start and a start"
        )

    def destroy(self) -> None:
        """Nothing listens."""


class TfTransforms:
    """Asks tf2 for the latest transform.

    It listens with a node and a thread of its own: transforms come often, and a wait for one must
    not keep it from arriving. (tf2's own thread would take the planner's node from its executor.)

    Args:
        tf2_ros: The module.
        node: The planner's node.
        timeout: Longest wait in seconds.
    """

    def __init__(self, tf2_ros: Any, node: Node, timeout: float) -> None:
        self._error: type[Exception] = tf2_ros.TransformException
        self._timeout = Duration(seconds=timeout)
        self._node = _listening_node(node)
        self._buffer = tf2_ros.Buffer()
        self._listener = tf2_ros.TransformListener(self._buffer, self._node)
        self._executor = SingleThreadedExecutor(context=node.context)
        self._executor.add_node(self._node)
        self._thread = threading.Thread(target=self._listen)  # ends with ROS at the latest
        self._thread.start()

    def lookup(self, target: str, source: str) -> Frame:
        """The latest pose of the frame `source` in the frame `target`."""
        try:
            found = self._buffer.lookup_transform(target, source, Time(), self._timeout)
        except self._error as error:
            raise TransformUnavailable(
                f"the pose of {source} in {target} is not known: {error}"
            ) from error
        move, turn = found.transform.translation, found.transform.rotation
        return Frame(move.x, move.y, yaw_of(turn.x, turn.y, turn.z, turn.w))

    def destroy(self) -> None:
        """Listen no more."""
        self._executor.shutdown()
        self._thread.join()
        self._node.destroy_node()

    def _listen(self) -> None:
        with contextlib.suppress(ExternalShutdownException):
            self._executor.spin()


def _listening_node(node: Node) -> Node:
    """A node beside another one. Its name also counts where a launch file renames the other."""
    name = f"{node.get_name()}_transforms"
    return rclpy.create_node(
        name,
        context=node.context,
        cli_args=["--ros-args", "-r", f"__node:={name}"],
        namespace=node.get_namespace(),
        enable_rosout=False,
        start_parameter_services=False,
    )


def make_transforms(node: Node, timeout: float) -> Transforms:
    """What this installation has."""
    try:
        import tf2_ros
    except ImportError:
        return NoTransforms()
    return TfTransforms(tf2_ros, node, timeout)


def in_frame(pose: Pose, frame: str, target: str, transforms: Transforms) -> Pose:
    """Express a pose of one frame in another.

    Args:
        pose: The pose.
        frame: Its frame.
        target: The frame wanted.
        transforms: Is asked if they differ.

    Raises:
        TransformUnavailable: Where the frame is is not known.
    """
    if frame == target:
        return pose
    x, y, yaw = transforms.lookup(target, frame).to_world(pose).tolist()
    return x, y, yaw
