"""Poses in other frames, where tf2 is installed."""

from __future__ import annotations

from typing import Any, Protocol

from planformer.geometry import Frame
from rclpy.duration import Duration
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


class NoTransforms:
    """Knows nothing; ROS without tf2_ros."""

    def lookup(self, target: str, source: str) -> Frame:
        """Always fails and says what would help."""
        raise TransformUnavailable(
            f"the pose of {source} in {target} is not known, because tf2_ros is not installed; "
            "send goals in the frame of the map with use_start and a start"
        )


class TfTransforms:
    """Asks tf2 for the latest transform.

    Args:
        tf2_ros: The module.
        node: The node that listens.
        timeout: Longest wait in seconds.
    """

    def __init__(self, tf2_ros: Any, node: Node, timeout: float) -> None:
        self._error: type[Exception] = tf2_ros.TransformException
        self._timeout = Duration(seconds=timeout)
        self._buffer = tf2_ros.Buffer(node=node)
        # In a thread of its own: a wait for a transform must not keep it from arriving.
        self._listener = tf2_ros.TransformListener(self._buffer, node, spin_thread=True)

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
