"""Settings as ROS parameters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from typing import Any, TypeVar

from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor
from rclpy.node import Node
from rclpy.parameter import Parameter

from planformer_ros.settings import About, Settings, Wiring, about

Kind = TypeVar("Kind", Settings, Wiring)


def declare(node: Node, kind: type[Kind], *, read_only: bool) -> None:
    """Declare a parameter for each setting, with its description and range."""
    rules = about(kind)
    for item in fields(kind):
        default = list(item.default) if isinstance(item.default, tuple) else item.default
        descriptor = _descriptor(item.name, default, rules[item.name], read_only=read_only)
        node.declare_parameter(item.name, default, descriptor)


def read(node: Node, kind: type[Kind], changes: Mapping[str, Any] | None = None) -> Kind:
    """Read the settings from the parameters.

    Args:
        node: A node that they are declared on.
        kind: Which settings.
        changes: Values that are to replace those of the node.

    Raises:
        InvalidParameter: A value is out of range.
    """
    names = [item.name for item in fields(kind)]
    values = {name: node.get_parameter(name).value for name in names}
    values |= {name: value for name, value in (changes or {}).items() if name in values}
    return kind(**{name: _from_ros(value) for name, value in values.items()})


def changes_of(parameters: list[Parameter[Any]]) -> dict[str, Any]:
    """New values by name."""
    return {parameter.name: parameter.value for parameter in parameters}


def _from_ros(value: Any) -> Any:
    return tuple(value) if isinstance(value, list) else value


def _descriptor(name: str, default: Any, rule: About, *, read_only: bool) -> ParameterDescriptor:
    descriptor = ParameterDescriptor(name=name, description=rule.description, read_only=read_only)
    if rule.one_of:
        descriptor.additional_constraints = f"one of: {', '.join(rule.one_of)}"
    if rule.between is not None:
        lowest, highest = rule.between
        if isinstance(default, float):
            descriptor.floating_point_range = [
                FloatingPointRange(from_value=float(lowest), to_value=float(highest))
            ]
        else:
            descriptor.integer_range = [
                IntegerRange(from_value=int(lowest), to_value=int(highest), step=1)
            ]
    return descriptor
