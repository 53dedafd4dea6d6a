"""The action server for paths: nav2_msgs/action/ComputePathToPose."""

from __future__ import annotations

import threading
import traceback
from collections.abc import Callable
from typing import Any

from geometry_msgs.msg import PoseStamped
from nav2_msgs.action import ComputePathToPose
from nav_msgs.msg import Path
from planformer import CancelToken
from planformer.errors import PlanformerError
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.action.server import ServerGoalHandle
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.node import Node
from std_msgs.msg import Header

from planformer_ros.error_codes import ErrorCode, code_of
from planformer_ros.messages import duration_of, path_message, pose_of
from planformer_ros.path import PathAnswer, answer_path
from planformer_ros.problem import Pose
from planformer_ros.settings import Settings, Wiring
from planformer_ros.transforms import Transforms, in_frame
from planformer_ros.views import Views
from planformer_ros.world import World

Goal = ComputePathToPose.Goal
Result = ComputePathToPose.Result
Handle = ServerGoalHandle[Any, Any, Any]


class PathServer:
    """Plans one path at a time; a new goal replaces the one in progress, as in Nav2.

    Args:
        node: The node that it belongs to.
        wiring: Frames.
        world: The maps.
        transforms: For poses in other frames.
        settings: Gives the settings of the moment.
        views: Shows paths and the regions that they were searched in.
    """

    def __init__(
        self,
        node: Node,
        wiring: Wiring,
        world: World,
        transforms: Transforms,
        settings: Callable[[], Settings],
        views: Views,
    ) -> None:
        self._node, self._wiring, self._world = node, wiring, world
        self._transforms, self._settings, self._views = transforms, settings, views
        self._is_active = False
        self._tokens: dict[bytes, CancelToken] = {}
        self._lock = threading.Lock()
        self._planning = threading.Lock()
        self._server = ActionServer(
            node,
            ComputePathToPose,
            "compute_path_to_pose",
            self._execute,
            callback_group=MutuallyExclusiveCallbackGroup(),
            goal_callback=self._on_goal,
            handle_accepted_callback=self._on_accepted,
            cancel_callback=self._on_cancel,
        )

    def activate(self) -> None:
        """Accept goals from now on."""
        self._is_active = True

    def deactivate(self) -> None:
        """Accept no more goals and give up those in progress."""
        self._is_active = False
        with self._lock:
            for token in self._tokens.values():
                token.cancel()

    def destroy(self) -> None:
        """Take the action away."""
        self.deactivate()
        self._server.destroy()

    def _on_goal(self, goal: Goal) -> GoalResponse:
        del goal
        return GoalResponse.ACCEPT if self._is_active else GoalResponse.REJECT

    def _on_accepted(self, handle: Handle) -> None:
        token = CancelToken()
        with self._lock:
            for older in self._tokens.values():
                older.cancel()
            self._tokens[bytes(handle.goal_id.uuid)] = token
        handle.execute()

    def _on_cancel(self, handle: Handle) -> CancelResponse:
        with self._lock:
            token = self._tokens.get(bytes(handle.goal_id.uuid))
        if token is not None:
            token.cancel()
        return CancelResponse.ACCEPT

    def _execute(self, handle: Handle) -> Result:
        key = bytes(handle.goal_id.uuid)
        try:
            with self._planning:  # one that was replaced ends soon
                answer = self._answer(handle.request, self._tokens[key])
        finally:
            with self._lock:
                del self._tokens[key]
        return self._finish(handle, answer)

    def _answer(self, goal: Goal, token: CancelToken) -> PathAnswer:
        try:
            start, target = self._start(goal), self._in_map(goal.goal)
        except PlanformerError as error:
            return PathAnswer(code=code_of(error), message=str(error))
        try:
            return answer_path(
                self._world.newest, start, target, goal.planner_id, self._settings(), token
            )
        except Exception as error:  # whatever it is, the robot's navigation has to go on
            self._node.get_logger().error(traceback.format_exc())
            return PathAnswer(code=ErrorCode.UNKNOWN, message=f"{type(error).__name__}: {error}")

    def _start(self, goal: Goal) -> Pose:
        if goal.use_start:
            return self._in_map(goal.start)
        robot, target = self._wiring.robot_base_frame, self._wiring.global_frame
        return in_frame((0.0, 0.0, 0.0), robot, target, self._transforms)

    def _in_map(self, pose: PoseStamped) -> Pose:
        target = self._wiring.global_frame
        return in_frame(pose_of(pose.pose), pose.header.frame_id, target, self._transforms)

    def _finish(self, handle: Handle, answer: PathAnswer) -> Result:
        header = Header(
            stamp=self._node.get_clock().now().to_msg(), frame_id=self._wiring.global_frame
        )
        result = Result(
            path=path_message(answer.poses, header),
            planning_time=duration_of(answer.seconds),
            error_code=int(answer.code),
        )
        if hasattr(result, "error_msg"):  # Jazzy's action has none
            result.error_msg = answer.message
        if answer.cancelled and handle.is_cancel_requested:
            handle.canceled()
        elif answer.cancelled:  # replaced by a newer goal, or the node was deactivated
            handle.abort()
        elif answer.code:
            self._node.get_logger().warning(f"no path ({answer.code.name}): {answer.message}")
            handle.abort()
        else:
            self._show(answer, result.path)
            handle.succeed()
        return result

    def _show(self, answer: PathAnswer, path: Path) -> None:
        self._views.show_path(path)
        if answer.fallback:
            self._node.get_logger().info(f"planned on the whole map: {answer.fallback}")
        if answer.region is not None and answer.costmap is not None:
            self._views.show_region(answer.region, answer.costmap, path.header)
