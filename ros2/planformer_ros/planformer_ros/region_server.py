"""The service that proposes regions: planformer_msgs/srv/ProposeRegion."""

from __future__ import annotations

import threading
import traceback
from collections.abc import Callable

from planformer.errors import PlanformerError
from planformer_msgs.srv import ProposeRegion
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.node import Node

from planformer_ros.error_codes import ErrorCode, code_of
from planformer_ros.messages import costmap_of_request, mask_values, pose_of
from planformer_ros.region import RegionAnswer, answer_region
from planformer_ros.settings import Settings
from planformer_ros.views import Views


class RegionServer:
    """Answers one request at a time, also while a path is planned.

    Args:
        node: The node that it belongs to.
        settings: Gives the settings of the moment.
        views: Shows the regions.
    """

    def __init__(self, node: Node, settings: Callable[[], Settings], views: Views) -> None:
        self._node, self._settings, self._views = node, settings, views
        self._is_active = False
        self._answering = threading.Lock()
        self._service = node.create_service(
            ProposeRegion,
            "propose_region",
            self._on_request,
            callback_group=MutuallyExclusiveCallbackGroup(),
        )

    def activate(self) -> None:
        """Answer from now on."""
        self._is_active = True

    def deactivate(self) -> None:
        """Answer no more, and wait for the answer in progress."""
        self._is_active = False
        with self._answering:
            pass

    def destroy(self) -> None:
        """Take the service away."""
        self._node.destroy_service(self._service)

    def _on_request(
        self, request: ProposeRegion.Request, response: ProposeRegion.Response
    ) -> ProposeRegion.Response:
        with self._answering:
            answer = self._answer(request)
        response.error_code = int(answer.code)
        response.error_msg = answer.message
        response.seconds = answer.seconds
        if answer.mask is not None:
            response.mask = mask_values(answer.mask)
        return response

    def _answer(self, request: ProposeRegion.Request) -> RegionAnswer:
        if not self._is_active:
            return RegionAnswer(None, 0.0, ErrorCode.UNKNOWN, "the node is not active")
        try:
            costmap = costmap_of_request(request)
            start, goal = pose_of(request.start), pose_of(request.goal)
            answer = answer_region(costmap, start, goal, request.guide, self._settings())
            if answer.mask is not None:
                self._views.show_region(answer.mask, costmap, request.header)
        except PlanformerError as error:
            answer = RegionAnswer(None, 0.0, code_of(error), str(error))
        except Exception as error:  # whatever it is, the robot's navigation has to go on
            self._node.get_logger().error(traceback.format_exc())
            message = f"{type(error).__name__}: {error}"
            answer = RegionAnswer(None, 0.0, ErrorCode.UNKNOWN, message)
        if answer.code:
            self._node.get_logger().warning(f"no region ({answer.code.name}): {answer.message}")
        return answer
