"""What the tests talk with: a planner in a process of its own, and a client node in this one."""

from __future__ import annotations

import array
import contextlib
import os
import shutil
import signal
import subprocess
import threading
import uuid
from pathlib import Path

import numpy as np
import rclpy
from action_msgs.msg import GoalStatus
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState, GetState
from map_msgs.msg import OccupancyGridUpdate
from nav2_msgs.action import ComputePathToPose
from nav_msgs.msg import OccupancyGrid
from planformer.maps import Costmap
from planformer_msgs.srv import ProposeRegion
from rcl_interfaces.msg import Parameter
from rcl_interfaces.srv import SetParameters
from rclpy.action import ActionClient
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.parameter import Parameter as ParameterValue

from planformer_ros.messages import metadata_of
from planformer_ros.qos import LATCHED

PATIENCE = 180.0
"""Seconds after which an answer will not come any more; nothing is measured with it."""

SUCCEEDED, CANCELED, ABORTED = (
    GoalStatus.STATUS_SUCCEEDED,
    GoalStatus.STATUS_CANCELED,
    GoalStatus.STATUS_ABORTED,
)
CONFIGURE, ACTIVATE, DEACTIVATE, CLEANUP, SHUTDOWN, ACTIVE_SHUTDOWN = (
    Transition.TRANSITION_CONFIGURE,
    Transition.TRANSITION_ACTIVATE,
    Transition.TRANSITION_DEACTIVATE,
    Transition.TRANSITION_CLEANUP,
    Transition.TRANSITION_INACTIVE_SHUTDOWN,
    Transition.TRANSITION_ACTIVE_SHUTDOWN,
)


class Planner:
    """The installed program in a process of its own.

    Args:
        folder: For its log.
        params_file: Its parameters, if not the defaults.
        namespace: Its namespace.
        with_tf2: Whether it finds tf2_ros, a stand-in.
        parameters: Those that count before the file's.
    """

    def __init__(
        self,
        folder: Path,
        params_file: Path | None = None,
        *,
        namespace: str = "",
        with_tf2: bool = False,
        **parameters,
    ) -> None:
        self._log = folder / "log.txt"
        path = os.environ["PYTHONPATH"]
        if with_tf2:
            path = f"{Path(__file__).with_name('stand_ins')}:{path}"
        arguments = ["-r", f"__ns:=/{namespace}"]
        if params_file is not None:
            arguments += ["--params-file", str(params_file)]
        for name, value in parameters.items():
            arguments += ["-p", f"{name}:={str(value).lower() if value is True else value}"]
        with self._log.open("w") as log:
            self.process = subprocess.Popen(
                [shutil.which("planner"), "--ros-args", *arguments],
                stdout=log,
                stderr=subprocess.STDOUT,
                env={**os.environ, "PYTHONPATH": path},
            )

    @property
    def log(self) -> str:
        return self._log.read_text()

    def __enter__(self) -> Planner:
        return self

    def __exit__(self, *exception) -> None:
        self.process.send_signal(signal.SIGINT)
        try:
            status = self.process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            self.process.kill()
            raise
        print(self.log)  # pytest shows it where a test fails
        assert status == 0, (status, self.log)
        assert "Traceback" not in self.log, self.log


class Client:
    """A node with all that a test asks the planner for; its answers arrive in another thread."""

    def __init__(self) -> None:
        self.node = rclpy.create_node(f"client_{uuid.uuid4().hex[:8]}")
        self._executor = SingleThreadedExecutor()
        self._executor.add_node(self.node)
        self._thread = threading.Thread(target=self._spin)
        self._actions = ActionClient(self.node, ComputePathToPose, "compute_path_to_pose")
        self._regions = self.node.create_client(ProposeRegion, "propose_region")
        self._publishers = {
            kind: self.node.create_publisher(message, topic, LATCHED)
            for kind, message, topic in (
                ("map", OccupancyGrid, "map"),
                ("costmap", OccupancyGrid, "global_costmap/costmap"),
                ("update", OccupancyGridUpdate, "global_costmap/costmap_updates"),
            )
        }

    def _spin(self) -> None:
        with contextlib.suppress(ExternalShutdownException):
            self._executor.spin()

    def __enter__(self) -> Client:
        self._thread.start()
        return self

    def __exit__(self, *exception) -> None:
        self._executor.shutdown()
        self._thread.join()
        self._actions.destroy()
        self.node.destroy_node()

    def wait(self, future):
        """The result of a future."""
        assert arrives(future, PATIENCE), "no answer"
        return future.result()

    def call(self, kind, name: str, request):
        """The answer of a service."""
        client = self.node.create_client(kind, name)
        try:
            return self._answer(client, request)
        finally:
            self.node.destroy_client(client)

    def _answer(self, client, request):
        """Ask, and ask again: an answer is lost if a busy server has not yet noticed its client."""
        assert client.wait_for_service(PATIENCE), client.srv_name
        for seconds in (10.0, 10.0, PATIENCE):
            future = client.call_async(request)
            if arrives(future, seconds):
                return future.result()
        raise AssertionError(f"no answer from {client.srv_name}")

    def region(self, costmap: Costmap, start, goal, guide: str = "") -> ProposeRegion.Response:
        """Ask for a region."""
        request = ProposeRegion.Request(guide=guide, info=metadata_of(costmap))
        request.header.frame_id = "map"
        request.costs = array.array("B", costmap.costs.tobytes())
        set_pose(request.start, start)
        set_pose(request.goal, goal)
        return self.ask(request)

    def ask(self, request: ProposeRegion.Request) -> ProposeRegion.Response:
        """Send a request for a region as it is."""
        return self._answer(self._regions, request)

    def send(self, goal: ComputePathToPose.Goal):
        """Send a goal; the handle says whether it was accepted."""
        assert self._actions.wait_for_server(PATIENCE)
        return self.wait(self._actions.send_goal_async(goal))

    def send_later(self, goal: ComputePathToPose.Goal):
        """The future handle of a goal."""
        return self._actions.send_goal_async(goal)

    def result(self, handle):
        """Status and result of an accepted goal."""
        assert handle.accepted
        answer = self.wait(handle.get_result_async())
        return answer.status, answer.result

    def plan(self, start, goal, **fields):
        """Status and result of a goal."""
        return self.result(self.send(make_goal(start, goal, **fields)))

    def cancel(self, handle):
        """The goals that a request to cancel this one will end."""
        return self.wait(handle.cancel_goal_async()).goals_canceling

    def publish_map(self, costmap: Costmap, frame: str = "map", values=None) -> None:
        """Publish a plain map, once the planner listens."""
        plain = np.select([costmap.costs == 255, costmap.costs >= 253], [-1, 100], 0)
        self._publish("map", costmap, plain if values is None else values, frame)

    def publish_costmap(self, costmap: Costmap, frame: str = "map", time: int = 0) -> None:
        """Publish a costmap, once the planner listens."""
        self._publish("costmap", costmap, costmap.to_published(), frame, time)

    def publish_update(self, costmap: Costmap, column: int, row: int, time: int = 0) -> None:
        """Publish an update of the costmap: the costs of a smaller one."""
        height, width = costmap.costs.shape
        message = OccupancyGridUpdate(x=column, y=row, width=width, height=height)
        message.header.frame_id, message.header.stamp.sec = "map", time
        message.data = array.array("b", costmap.to_published().tobytes())
        self._send("update", message)

    def _publish(self, kind: str, costmap: Costmap, values, frame: str, time: int = 0) -> None:
        message = OccupancyGrid(info=metadata_of(costmap))
        message.header.frame_id, message.header.stamp.sec = frame, time
        message.data = array.array("b", np.asarray(values, np.int8).tobytes())
        self._send(kind, message)

    def _send(self, kind: str, message) -> None:
        publisher = self._publishers[kind]
        until(lambda: publisher.get_subscription_count() > 0)
        publisher.publish(message)

    def latest(self, kind, topic: str):
        """The last message of a latched topic."""
        arrived, messages = threading.Event(), []

        def take(message) -> None:
            messages.append(message)
            arrived.set()

        subscription = self.node.create_subscription(kind, topic, take, LATCHED)
        try:
            assert arrived.wait(PATIENCE), topic
        finally:
            self.node.destroy_subscription(subscription)
        return messages[-1]

    def change_state(self, transition: int) -> bool:
        """Ask the planner for a transition."""
        request = ChangeState.Request(transition=Transition(id=transition))
        return self.call(ChangeState, "/planformer/change_state", request).success

    def state(self) -> str:
        """The planner's state."""
        return self.call(GetState, "/planformer/get_state", GetState.Request()).current_state.label

    def set_parameter(self, name: str, value) -> str | None:
        """Change a parameter; the reason if that is refused."""
        parameter: Parameter = ParameterValue(name, value=value).to_parameter_msg()
        request = SetParameters.Request(parameters=[parameter])
        answer = self.call(SetParameters, "/planformer/set_parameters", request).results[0]
        return None if answer.successful else answer.reason


def arrives(future, seconds: float) -> bool:
    """Whether a future is done in time."""
    done = threading.Event()
    future.add_done_callback(lambda _: done.set())
    return done.wait(seconds)


def until(condition) -> None:
    """Wait for something that another process is about to do."""
    pause = threading.Event()
    for _ in range(int(PATIENCE / 0.02)):
        if condition():
            return
        pause.wait(0.02)
    raise AssertionError("it did not happen")


def make_goal(start, goal, *, planner_id="", frame="map", start_frame="map", use_start=True):
    """A goal of the action."""
    message = ComputePathToPose.Goal(planner_id=planner_id, use_start=use_start)
    message.start.header.frame_id, message.goal.header.frame_id = start_frame, frame
    set_pose(message.start.pose, start)
    set_pose(message.goal.pose, goal)
    return message


def set_pose(message, pose) -> None:
    """Fill a geometry_msgs/Pose."""
    x, y, yaw = [*pose, 0.0][:3]
    message.position.x, message.position.y = float(x), float(y)
    message.orientation.z, message.orientation.w = float(np.sin(yaw / 2)), float(np.cos(yaw / 2))


def poses_of(path) -> np.ndarray:
    """(N, 3) poses of a nav_msgs/Path."""
    return np.array(
        [
            (
                pose.pose.position.x,
                pose.pose.position.y,
                2.0 * np.arctan2(pose.pose.orientation.z, pose.pose.orientation.w),
            )
            for pose in path.poses
        ]
    ).reshape(-1, 3)
