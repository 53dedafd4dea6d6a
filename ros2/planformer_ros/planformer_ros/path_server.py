"""The action server for paths: nav2_msgs/action/ComputePathToPose."""

from __future__ import annotations

import threading
import time
import traceback
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from geometry_msgs.msg import PoseStamped
from nav2_msgs.action import ComputePathToPose
from nav_msgs.msg import Path
from planformer import CancelToken
from planformer.errors import PlanformerError
from rclpy.action.server import ActionServer, CancelResponse, GoalResponse, ServerGoalHandle
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.impl.implementation_singleton import rclpy_implementation
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

Handle = ServerGoalHandle[Any, Any, Any]

_PERIOD = 0.01
"""Seconds between two looks at what another thread is about to change."""

_PATIENCE = 5.0
"""Longest wait [s] for goals that are given up. They end within milliseconds, unless a proposal is
under way on a large map."""


@dataclass
class _Job:
    """A goal in progress.

    Attributes:
        handle: The action's handle of it.
        token: Ends its search.
        cancelled_by_client: Whether its client asked for that, and not a newer goal.
        is_decided: Whether its answer is there, which makes it too late to cancel.
    """

    handle: Handle
    token: CancelToken
    cancelled_by_client: bool = False
    is_decided: bool = False


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
        self._jobs: dict[bytes, _Job] = {}
        self._lock = threading.Lock()
        self._ended = threading.Condition(self._lock)
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
        """Accept no more goals, give up those in progress and wait for their end."""
        self._is_active = False
        with self._lock:
            self._cancel_all()
            self._ended.wait_for(lambda: not self._jobs, _PATIENCE)

    def destroy(self) -> None:
        """Take the action away."""
        self._server.destroy()

    def _cancel_all(self) -> None:
        for job in self._jobs.values():
            job.token.cancel()

    def _on_goal(self, goal: ComputePathToPose.Goal) -> GoalResponse:
        del goal
        return GoalResponse.ACCEPT if self._is_active else GoalResponse.REJECT

    def _on_accepted(self, handle: Handle) -> None:
        job = _Job(handle, CancelToken())
        with self._lock:
            self._cancel_all()
            if not self._is_active:  # since it was accepted
                job.token.cancel()
            self._jobs[_key(handle)] = job
        handle.execute()

    def _on_cancel(self, handle: Handle) -> CancelResponse:
        with self._lock:
            job = self._jobs.get(_key(handle))
            if job is None or job.is_decided:
                return CancelResponse.REJECT
            job.cancelled_by_client = True
            job.token.cancel()
        return CancelResponse.ACCEPT

    def _execute(self, handle: Handle) -> ComputePathToPose.Result:
        job = self._jobs[_key(handle)]
        try:
            return self._finish(job, self._answer_in_turn(handle.request, job.token))
        finally:
            with self._lock:
                del self._jobs[_key(handle)]
                self._ended.notify_all()

    def _finish(self, job: _Job, answer: PathAnswer) -> ComputePathToPose.Result:
        with self._lock:
            job.is_decided = True
        result = self._result(answer)
        try:
            self._end(job, answer, result)
        except rclpy_implementation.RCLError:
            if self._node.context.ok():
                raise
            # Interrupted: ROS is gone already, and nobody can be told any more.
        return result

    def _answer_in_turn(self, goal: ComputePathToPose.Goal, token: CancelToken) -> PathAnswer:
        """Wait for the goal that this one replaced, which ends soon, then answer."""
        while not self._planning.acquire(timeout=_PERIOD):
            if token.is_cancelled:
                return PathAnswer(cancelled=True, message="cancelled before its turn came")
        try:
            return self._answer(goal, token)
        finally:
            self._planning.release()

    def _answer(self, goal: ComputePathToPose.Goal, token: CancelToken) -> PathAnswer:
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

    def _start(self, goal: ComputePathToPose.Goal) -> Pose:
        if goal.use_start:
            return self._in_map(goal.start)
        robot, target = self._wiring.robot_base_frame, self._wiring.global_frame
        return in_frame((0.0, 0.0, 0.0), robot, target, self._transforms)

    def _in_map(self, pose: PoseStamped) -> Pose:
        target = self._wiring.global_frame
        return in_frame(pose_of(pose.pose), pose.header.frame_id, target, self._transforms)

    def _result(self, answer: PathAnswer) -> ComputePathToPose.Result:
        header = Header(
            stamp=self._node.get_clock().now().to_msg(), frame_id=self._wiring.global_frame
        )
        result = ComputePathToPose.Result(
            path=path_message(answer.poses, header),
            planning_time=duration_of(answer.seconds),
            error_code=int(answer.code),
        )
        if hasattr(result, "error_msg"):  # Jazzy's action has none
            result.error_msg = answer.message
        return result

    def _end(self, job: _Job, answer: PathAnswer, result: ComputePathToPose.Result) -> None:
        """Bring the goal into the state that it ends in."""
        if job.cancelled_by_client:
            # It is once `_on_cancel` has returned, unless the action was taken away.
            while job.handle.is_active and not job.handle.is_cancel_requested:
                time.sleep(_PERIOD)
            job.handle.canceled()
        elif answer.cancelled:  # for a newer goal, or the node was deactivated
            job.handle.abort()
        elif answer.code:
            self._node.get_logger().warning(f"no path ({answer.code.name}): {answer.message}")
            job.handle.abort()
        else:
            self._show(answer, result.path)
            job.handle.succeed()

    def _show(self, answer: PathAnswer, path: Path) -> None:
        self._views.show_path(path)
        if answer.fallback:
            self._node.get_logger().info(f"planned on the whole map: {answer.fallback}")
        if answer.region is not None and answer.costmap is not None:
            self._views.show_region(answer.region, answer.costmap, path.header)


def _key(handle: Handle) -> bytes:
    return bytes(handle.goal_id.uuid)
