"""The lifecycle node of planformer."""

from __future__ import annotations

from typing import Any

from planformer.errors import PlanformerError
from rcl_interfaces.msg import SetParametersResult
from rclpy.expand_topic_name import expand_topic_name
from rclpy.lifecycle import LifecycleNode, LifecycleState, TransitionCallbackReturn
from rclpy.parameter import Parameter
from rclpy.validate_full_topic_name import validate_full_topic_name
from rclpy.validate_topic_name import validate_topic_name

from planformer_ros import parameters
from planformer_ros.map_inputs import MapInputs
from planformer_ros.path_server import PathServer
from planformer_ros.region_server import RegionServer
from planformer_ros.settings import Settings, Wiring
from planformer_ros.transforms import make_transforms
from planformer_ros.views import Views
from planformer_ros.world import World


class PlanformerNode(LifecycleNode):
    """Answers requests for regions and goals for paths while it is active.

    Maps are received from the configuration on, so that it can plan as soon as it is active.

    Raises:
        InvalidParameter: A parameter is out of range. Also rclpy's ParameterException, and its
            NameValidationException for a topic that is none.
    """

    def __init__(self) -> None:
        super().__init__("planformer")
        parameters.declare(self, Settings, read_only=False)
        parameters.declare(self, Wiring, read_only=True)
        self.wiring = parameters.read(self, Wiring)
        self.settings = parameters.read(self, Settings)
        for topic in filter(None, (self.wiring.map_topic, self.wiring.costmap_topic)):
            validate_topic_name(topic)
            full_name = expand_topic_name(topic, self.get_name(), self.get_namespace())
            validate_full_topic_name(full_name)
        self._parts: _Parts | None = None
        self.add_on_set_parameters_callback(self._check_parameters)
        self.add_post_set_parameters_callback(self._take_parameters)

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Load the weights and connect; fails where there is no such planner or weights."""
        try:
            self.settings.check_names()
        except PlanformerError as error:
            self.get_logger().error(str(error))
            return TransitionCallbackReturn.FAILURE
        self._parts = _Parts(self)
        return super().on_configure(state)

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Answer from now on."""
        outcome = super().on_activate(state)
        if self._parts is not None:
            self._parts.activate()
        return outcome

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Give up what is in progress and answer no more."""
        self.stop()
        return super().on_deactivate(state)

    def on_cleanup(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Disconnect and forget the maps."""
        if self._parts is not None:
            self._parts.destroy()
            self._parts = None
        return super().on_cleanup(state)

    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Give up what is in progress and answer no more."""
        self.stop()
        return super().on_shutdown(state)

    def stop(self) -> None:
        """Give up what is in progress and answer no more."""
        if self._parts is not None:
            self._parts.deactivate()

    def _check_parameters(self, changed: list[Parameter[Any]]) -> SetParametersResult:
        """Accept new settings as a whole, or refuse them and say why."""
        try:
            parameters.read(self, Settings, parameters.changes_of(changed)).check_names()
        except PlanformerError as error:
            return SetParametersResult(successful=False, reason=str(error))
        return SetParametersResult(successful=True)

    def _take_parameters(self, changed: list[Parameter[Any]]) -> None:
        """Use what has been accepted, by other callbacks too."""
        del changed
        self.settings = parameters.read(self, Settings)


class _Parts:
    """What a configured node is connected to."""

    def __init__(self, node: PlanformerNode) -> None:
        def settings() -> Settings:
            return node.settings

        world = World()
        self._transforms = make_transforms(node, node.wiring.transform_timeout)
        self._maps = MapInputs(node, node.wiring, world)
        self._views = Views(node)
        self._servers = (
            RegionServer(node, settings, self._views),
            PathServer(node, node.wiring, world, self._transforms, settings, self._views),
        )

    def activate(self) -> None:
        for server in self._servers:
            server.activate()

    def deactivate(self) -> None:
        for server in self._servers:
            server.deactivate()

    def destroy(self) -> None:
        for part in (*self._servers, self._maps, self._views, self._transforms):
            part.destroy()
