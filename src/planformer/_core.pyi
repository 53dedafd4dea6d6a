"""Types of the compiled core (cpp/bindings); everything is in the map's local frame.

Arrays that go in are converted to the type given here when they are of another one.
"""

import enum
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

# planning.cpp

class RobotKind(enum.Enum):
    POINT = 0
    CAR = 1

class Outcome(enum.Enum):
    FINISHED = 0
    TARGET = 1
    TIME_LIMIT = 2
    VERTEX_LIMIT = 3
    CANCELLED = 4

class RobotModel:
    def __init__(
        self,
        kind: RobotKind,
        turning_radius: float = 0.0,
        reverse: bool = False,
        wheelbase: float = 0.0,
        max_speed: float = 0.0,
    ) -> None: ...

class Limits:
    def __init__(
        self,
        seconds: float | None = None,
        target_length: float | None = None,
        vertices: int | None = None,
    ) -> None: ...

class Cancellation:
    """Ends a plan from another thread."""

    def __init__(self) -> None: ...
    def cancel(self) -> None: ...
    @property
    def is_cancelled(self) -> bool: ...

class Snapshot:
    @property
    def seconds(self) -> float: ...
    @property
    def length(self) -> float: ...
    @property
    def states(self) -> int: ...
    @property
    def path(self) -> NDArray[np.float64]: ...  # (N, 3)
    @property
    def tree_vertices(self) -> NDArray[np.float64]: ...  # (V, 3)
    @property
    def tree_edges(self) -> NDArray[np.uint32]: ...  # (E, 2): parent, child

class Progress:
    """The last snapshot of a plan; thread-safe."""

    def __init__(self, interval: float, keep_tree: bool) -> None: ...
    def latest(self) -> Snapshot | None: ...

class Ends:
    def __init__(
        self,
        start: list[float],  # x, y [m], yaw [rad]
        goal: list[float],
        turning_radius: float,
    ) -> None: ...

class Region:
    def __init__(
        self,
        anchors: NDArray[np.float64],  # (N, 3): x, y [m], yaw [rad]
        offsets: NDArray[np.float64],  # (N, 2) [m]
        *,
        has_heading: bool,
        half_width: float,
        minor_axis: float,
        yaw_deviations: NDArray[np.float64],  # (N,) [rad]
        ends: Ends | None,
        area: float,
    ) -> None: ...
    def sample(self, count: int, seed: int) -> NDArray[np.float64]: ...  # (count, 3)

class Answer:
    @property
    def path(self) -> NDArray[np.float64]: ...  # (N, 3)
    @property
    def length(self) -> float: ...
    @property
    def vertices(self) -> int: ...
    @property
    def seconds(self) -> float: ...
    @property
    def outcome(self) -> Outcome: ...
    @property
    def tree_vertices(self) -> NDArray[np.float64]: ...  # (V, 3)
    @property
    def tree_edges(self) -> NDArray[np.uint32]: ...  # (E, 2): parent, child

def plan(
    blocked: NDArray[np.bool_],
    resolution: float,
    robot: RobotModel,
    start: Sequence[float],
    goal: Sequence[float],
    *,
    planner: str,
    region: Region | None = None,
    exploration: float = 0.0,
    refinement: float = 0.0,
    limits: Limits,
    seed: int,
    keep_tree: bool = False,
    cancellation: Cancellation | None = None,
    progress: Progress | None = None,
    handle_signals: bool = False,
) -> Answer: ...
def planner_names(robot: RobotKind) -> list[str]: ...
def segment_is_free(
    blocked: NDArray[np.bool_], resolution: float, x0: float, y0: float, x1: float, y1: float
) -> bool: ...

# grid_search.cpp

def lazy_theta(
    blocked: NDArray[np.bool_],
    resolution: float,
    start: NDArray[np.float64],
    goal: NDArray[np.float64],
) -> NDArray[np.float64]: ...
def astar(
    blocked: NDArray[np.bool_],
    resolution: float,
    start: NDArray[np.float64],
    goal: NDArray[np.float64],
) -> NDArray[np.float64]: ...
def hybrid_astar(
    blocked: NDArray[np.bool_],
    resolution: float,
    turning_radius: float,
    reverse: bool,
    start: NDArray[np.float64],
    goal: NDArray[np.float64],
    max_expansions: int,
) -> NDArray[np.float64]: ...
def detours(
    blocked: NDArray[np.bool_],
    start: tuple[int, int],
    goal: tuple[int, int],
    limit: float,
    side: int,
) -> NDArray[np.float32] | None: ...
def widest_path(
    blocked: NDArray[np.bool_],
    values: NDArray[np.float32],
    start: Sequence[int],
    goal: Sequence[int],
) -> float | None: ...

# curves.cpp

def curve_lengths(
    starts: NDArray[np.float64],
    goals: NDArray[np.float64],
    turning_radius: float,
    reverse: bool,
) -> NDArray[np.float64]: ...
def curve_poses(
    start: NDArray[np.float64],
    goal: NDArray[np.float64],
    turning_radius: float,
    reverse: bool,
    step: float,
) -> NDArray[np.float64]: ...
