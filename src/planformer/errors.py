"""Every error that planformer raises on purpose.

    PlanformerError
    ├── InvalidMap              a map file or array that cannot be a map
    ├── InvalidRobot            a robot with an impossible dimension
    ├── InvalidProblem          start and goal that cannot be planned between
    │   ├── StartOutsideMap
    │   ├── GoalOutsideMap
    │   ├── StartOccupied       ``.nearest_free`` names the closest valid point
    │   └── GoalOccupied        ``.nearest_free`` names the closest valid point
    ├── InvalidParameter        a value outside its range, an unknown setting
    │   ├── UnknownPlanner      lists the valid names
    │   └── UnknownGuide        lists the valid names
    ├── InvalidDataset          a data set that is damaged or does not fit
    ├── InvalidResults          measurements that are damaged or do not fit the request
    ├── InvalidWeights          a weights file or card that cannot be used
    │   └── WeightsMismatch     weights that do not fit the problem or the card
    ├── TrainingDiverged        a loss that is no number; ``.step`` and ``.learning_rate`` say where
    ├── RequestRefused          a request that the planning service does not take
    │   ├── UnknownMap          no map has the id
    │   ├── TooLarge            an upload, a map or a request beyond the service's limits
    │   ├── StoreFull           no room for another map
    │   ├── Busy                as many plans as the service may run are running
    │   └── ShuttingDown        the service is about to end
    └── MissingExtra            an optional dependency, with its install command

The problem errors mirror the exceptions of Nav2's planner server, so that a ROS wrapper can map
them one to one. A search that finds no path is not an error: see ``PlanResult.status``.
"""

from __future__ import annotations


class PlanformerError(Exception):
    """Base class of all errors that planformer raises on purpose."""


class InvalidMap(PlanformerError, ValueError):
    """A map file or array that cannot be a map."""


class InvalidRobot(PlanformerError, ValueError):
    """A robot with an impossible dimension."""


class InvalidProblem(PlanformerError, ValueError):
    """A start and goal that cannot be planned between."""


class StartOutsideMap(InvalidProblem):
    """The start lies outside the map."""


class GoalOutsideMap(InvalidProblem):
    """The goal lies outside the map."""


class _Occupied(InvalidProblem):
    """A state in collision.

    Attributes:
        nearest_free: The closest collision-free point (x, y) in metres, None if the map has none.
    """

    def __init__(self, message: str, nearest_free: tuple[float, float] | None = None) -> None:
        super().__init__(message)
        self.nearest_free = nearest_free


class StartOccupied(_Occupied):
    """The robot would touch an obstacle at the start."""


class GoalOccupied(_Occupied):
    """The robot would touch an obstacle at the goal."""


class InvalidParameter(PlanformerError, ValueError):
    """A value outside its range or an unknown setting."""


class UnknownPlanner(InvalidParameter):
    """A planner name that this build does not have for this robot."""


class UnknownGuide(InvalidParameter):
    """A guide name for which no weights exist."""


class InvalidDataset(PlanformerError, ValueError):
    """A data set that is damaged or does not fit the request."""


class InvalidResults(PlanformerError, ValueError):
    """Measurements that are damaged or do not fit the request."""


class InvalidWeights(PlanformerError, ValueError):
    """A weights file or its card that cannot be used."""


class WeightsMismatch(InvalidWeights):
    """Weights that do not fit the problem, the network, the training or their own card."""


class TrainingDiverged(PlanformerError, ArithmeticError):
    """The loss or its gradient is infinite or no number.

    Attributes:
        step: Optimiser steps taken before.
        learning_rate: Learning rate of the step that was not taken.
    """

    def __init__(self, message: str, *, step: int, learning_rate: float) -> None:
        super().__init__(message)
        self.step, self.learning_rate = step, learning_rate


class RequestRefused(PlanformerError):
    """A request that the planning service does not take."""


class UnknownMap(RequestRefused):
    """The service has no map of this id."""


class TooLarge(RequestRefused):
    """An upload, a map or a request that is larger than the service's limits allow."""


class StoreFull(RequestRefused):
    """The service's folder holds as many maps as it may, or cannot be written to."""


class Busy(RequestRefused):
    """As many plans as the service may run are running; ask again in a second."""


class ShuttingDown(RequestRefused):
    """The service is about to end."""


class MissingExtra(PlanformerError, ImportError):
    """An optional dependency is not installed.

    Args:
        package: The import that failed.
        extra: The extra of planformer that provides it.
    """

    def __init__(self, package: str, extra: str) -> None:
        super().__init__(
            f"{package} is not installed; install it with: pip install 'planformer[{extra}]'"
        )
