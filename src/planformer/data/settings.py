"""From what is asked for to a data set's settings: presets, and defaults that suit the robot."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import fields, replace
from pathlib import Path
from types import MappingProxyType
from typing import Any

from planformer.data.experts import Expert, create_expert, expert_names
from planformer.data.recipe import StoredMap, checksum
from planformer.data.robot import make_robot
from planformer.data.spec import DatasetSpec
from planformer.data.user_maps import read_user_maps
from planformer.errors import InvalidParameter

_ROBOT_DEFAULTS: Mapping[str, Mapping[str, Any]] = MappingProxyType(
    {
        "point": {"robot_radius": 0.1, "min_distance": 3.0},
        "dubins": {
            "robot_radius": 0.2,
            "turning_radius": 0.3 / math.tan(0.5),  # wheelbase 0.3 m, steering up to 0.5 rad
            "min_distance": 4.0,
            "max_distance": 15.0,
        },
    }
)
"""The robots and distances of the paper's experiments."""

PRESETS: Mapping[str, Mapping[str, Any]] = MappingProxyType(
    {
        "paper": {"kinds": ("forest", "maze"), "maps": 1750, "robot": "point"},
        "paper-dubins": {"kinds": ("forest",), "maps": 900, "robot": "dubins"},
    }
)
"""The training sets of Johnson et al., Motion Planning Transformers, section IV."""

_FREE_WITH_PRESET = (
    "maps",
    "paths_per_map",
    "seed",
    "expert",
    "expert_seconds",
    "expert_vertices",
    "maps_per_shard",
)
"""Settings that may be given along with a preset: how much of it, and who solves it."""


def settled(
    asked: Mapping[str, Any], *, preset: str | None = None, maps_from: Path | None = None
) -> tuple[DatasetSpec, list[StoredMap]]:
    """The settings of a data set and the users' own maps in it.

    Args:
        asked: Attributes of `DatasetSpec` but for `user_maps`; None counts as not asked for.
        preset: A name in `PRESETS`; it fixes maps and robot, so that only the number of maps and
            paths, the seed, the expert and the size of shards may be asked for besides.
        maps_from: Folder of the users' own maps.

    Raises:
        InvalidParameter: A setting is unknown, out of range, missing or fixed by the preset.
        InvalidRobot: A dimension of the robot is out of range.
        InvalidMap: A map in `maps_from` cannot be used.
    """
    values = {name: value for name, value in asked.items() if value is not None}
    _check_names(values)
    if preset is not None:
        _check_preset(preset, values, maps_from)
        values = {**PRESETS[preset], **values}
    values = _with_defaults(values, generated=maps_from is None)
    own = [] if maps_from is None else _own_maps(maps_from, values)
    named = tuple((own_map.name, checksum(own_map.grid().occupied)) for own_map in own)
    return DatasetSpec(**values, user_maps=named), own


def make_expert(spec: DatasetSpec) -> Expert:
    """The expert of a data set, with the limits that were asked for.

    Raises:
        InvalidParameter: The robot has no such expert, or it knows no such limit.
    """
    expert: Any = create_expert(spec.expert, spec.make_robot())
    limits = {"seconds": spec.expert_seconds, "max_vertices": spec.expert_vertices}
    given = {name: value for name, value in limits.items() if value is not None}
    unknown = given.keys() - {field.name for field in fields(expert)}
    if unknown:
        raise InvalidParameter(f"the expert {spec.expert} has no limit {', '.join(unknown)}")
    limited: Expert = replace(expert, **given)
    return limited


def _with_defaults(values: Mapping[str, Any], *, generated: bool) -> dict[str, Any]:
    kinds = values.get("kinds", ("forest", "maze") if generated else ())
    if kinds and "maps" not in values:
        raise InvalidParameter("say how many maps of each kind to generate, or name a preset")
    robot = values.get("robot", "point")
    settings = {
        "maps": 0,
        "paths_per_map": 25,
        "seed": 0,
        "robot": robot,
        **_ROBOT_DEFAULTS.get(robot, {}),
        **values,
        "kinds": kinds,
    }
    made = make_robot(robot, settings.get("robot_radius", 0.0), settings.get("turning_radius"))
    settings.setdefault("expert", expert_names(made)[0])
    return settings


def _own_maps(folder: Path, values: Mapping[str, Any]) -> list[StoredMap]:
    return read_user_maps(
        folder,
        resolution=values.get("resolution", DatasetSpec.resolution),
        robot_radius=values["robot_radius"],
        min_distance=values["min_distance"],
        max_distance=values.get("max_distance"),
    )


def _check_names(values: Mapping[str, Any]) -> None:
    known = {field.name for field in fields(DatasetSpec)} - {"user_maps"}
    unknown = values.keys() - known
    if unknown:
        raise InvalidParameter(
            f"unknown settings {', '.join(sorted(unknown))}; known: {', '.join(sorted(known))}"
        )


def _check_preset(preset: str, values: Mapping[str, Any], maps_from: Path | None) -> None:
    if preset not in PRESETS:
        raise InvalidParameter(f"unknown preset {preset!r}; choose from {', '.join(PRESETS)}")
    fixed = [name for name in values if name not in _FREE_WITH_PRESET]
    if fixed or maps_from is not None:
        names = [*fixed, *(["maps_from"] if maps_from is not None else [])]
        raise InvalidParameter(
            f"the preset {preset} fixes {', '.join(names)}; leave that out, or the preset "
            f"(beside it one may choose {', '.join(_FREE_WITH_PRESET)})"
        )
