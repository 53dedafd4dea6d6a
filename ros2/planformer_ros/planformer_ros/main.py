"""Runs the node: `ros2 run planformer_ros planner`."""

from __future__ import annotations

import sys

import rclpy
from planformer.errors import PlanformerError
from rclpy.exceptions import NameValidationException, ParameterException
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.lifecycle import TransitionCallbackReturn

from planformer_ros.node import PlanformerNode

_THREADS = 6
"""A path in progress, one that it replaces, a region, a map, a transition, and one that is free."""


def main(args: list[str] | None = None) -> int:
    """Run until interrupted.

    Args:
        args: Arguments of ROS, those of the process by default.

    Returns:
        The exit status: 1 where a parameter is wrong or autostart fails.
    """
    rclpy.init(args=args)
    try:
        node = PlanformerNode()
    except (PlanformerError, ParameterException, NameValidationException) as error:
        print(f"planformer: {error}", file=sys.stderr)
        rclpy.try_shutdown()
        return 1
    executor = MultiThreadedExecutor(num_threads=_THREADS)
    executor.add_node(node)
    try:
        if node.wiring.autostart and not _start(node):
            return 1
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.stop()
        executor.shutdown()
        node.destroy_node()
        rclpy.try_shutdown()
    return 0


def _start(node: PlanformerNode) -> bool:
    done = TransitionCallbackReturn.SUCCESS
    return node.trigger_configure() == done and node.trigger_activate() == done


if __name__ == "__main__":
    sys.exit(main())
