"""What can guide a planner."""

from __future__ import annotations

import os
from typing import Protocol, TypeAlias, runtime_checkable

from planformer.errors import InvalidParameter, UnknownGuide
from planformer.guidance.onnx import OnnxProposer, load_network
from planformer.guidance.region import Region
from planformer.guidance.weights import default_guide
from planformer.planning import Problem
from planformer.robots import Robot

AUTO = "auto"
"""As the name of a guide or planner: the one recommended for the robot."""


@runtime_checkable
class RegionProposer(Protocol):
    """Anything that proposes where on a map a good path runs."""

    def propose(self, problem: Problem) -> Region:
        """Propose a region for a problem."""
        ...


Guide: TypeAlias = str | os.PathLike[str] | RegionProposer
"""What `resolve_guide` takes."""


def resolve_guide(guide: Guide, robot: Robot, threshold: float | None = None) -> RegionProposer:
    """Turn the name of shipped weights or the path of an .onnx file into a proposer.

    Args:
        guide: `AUTO`, another name, a path, or a proposer, which is returned as it is.
        robot: The robot that `AUTO` chooses for.
        threshold: As in `OnnxProposer`.

    Raises:
        UnknownGuide: The name is unknown, or the object cannot propose regions.
        InvalidParameter: A threshold is out of range, or given for an object that has its own.
    """
    if isinstance(guide, os.PathLike):
        guide = os.fspath(guide)
    if guide == AUTO:
        guide = default_guide(robot)
    if isinstance(guide, str):
        return OnnxProposer(load_network(guide), threshold)
    if not isinstance(guide, RegionProposer) or isinstance(guide, type):
        raise UnknownGuide(f"guide must be a name, a path or a RegionProposer; got {guide!r:.80}")
    if threshold is not None:
        raise InvalidParameter(
            f"a threshold needs the name of weights as guide; set it in the {type(guide).__name__}"
        )
    return guide
