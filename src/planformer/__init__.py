"""planformer: learned guidance for sampling-based motion planning on maps.

The names below are the public interface. They are loaded on first use (PEP 562), so that training
runs from a plain source tree in which the compiled core has not been built.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

from planformer import errors
from planformer.errors import PlanformerError

if TYPE_CHECKING:
    from planformer.api import default_planner as default_planner
    from planformer.api import plan as plan
    from planformer.api import planner_names as planner_names
    from planformer.api import propose_region as propose_region
    from planformer.guidance import Region as Region
    from planformer.guidance import RegionProposer as RegionProposer
    from planformer.guidance import default_guide as default_guide
    from planformer.guidance import guide_names as guide_names
    from planformer.maps import OccupancyGrid as OccupancyGrid
    from planformer.maps import generate_forest as generate_forest
    from planformer.maps import generate_indoor as generate_indoor
    from planformer.maps import generate_maze as generate_maze
    from planformer.maps import load_map as load_map
    from planformer.maps import load_scenarios as load_scenarios
    from planformer.maps import save_map as save_map
    from planformer.planning import CancelToken as CancelToken
    from planformer.planning import PlanResult as PlanResult
    from planformer.planning import PlanStatus as PlanStatus
    from planformer.planning import Problem as Problem
    from planformer.planning import Progress as Progress
    from planformer.planning import path_is_valid as path_is_valid
    from planformer.robots import DubinsCar as DubinsCar
    from planformer.robots import PointRobot as PointRobot
    from planformer.robots import ReedsSheppCar as ReedsSheppCar
    from planformer.session import MapSession as MapSession

__version__ = "0.1.0"

_HOME = {
    "CancelToken": "planning",
    "DubinsCar": "robots",
    "MapSession": "session",
    "OccupancyGrid": "maps",
    "PlanResult": "planning",
    "PlanStatus": "planning",
    "PointRobot": "robots",
    "Problem": "planning",
    "Progress": "planning",
    "ReedsSheppCar": "robots",
    "Region": "guidance",
    "RegionProposer": "guidance",
    "default_guide": "guidance",
    "default_planner": "api",
    "generate_forest": "maps",
    "generate_indoor": "maps",
    "generate_maze": "maps",
    "guide_names": "guidance",
    "load_map": "maps",
    "load_scenarios": "maps",
    "path_is_valid": "planning",
    "plan": "api",
    "planner_names": "api",
    "propose_region": "api",
    "save_map": "maps",
}

__all__ = ["PlanformerError", "errors", *_HOME]


if not TYPE_CHECKING:  # a type checker would take every misspelt name for an attribute

    def __getattr__(name: str) -> Any:
        if name not in _HOME:
            raise AttributeError(f"module 'planformer' has no attribute {name!r}")
        value = getattr(importlib.import_module(f"planformer.{_HOME[name]}"), name)
        globals()[name] = value
        return value


def __dir__() -> list[str]:
    return sorted({*globals(), *_HOME})
