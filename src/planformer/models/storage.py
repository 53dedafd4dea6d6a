"""Networks on disk."""

from __future__ import annotations

import pickle
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, TypeVar

import torch
from torch import nn

from planformer.errors import InvalidWeights
from planformer.files import whole_file
from planformer.models.config import MPTConfig
from planformer.models.create import create_model
from planformer.models.mpnet import MPNet, MPNetConfig
from planformer.models.next_ks import NextConfig, NextNetwork

_Model = TypeVar("_Model", bound=nn.Module)


def save_checkpoint(path: Path, config: MPTConfig, model: nn.Module, **state: Any) -> None:
    """Store a region proposal network with its configuration and what belongs to its training.

    Args:
        path: The file to replace; its folder is created.
        config: Configuration of the network.
        model: The network.
        **state: Further entries: tensors, numbers, strings and containers of them.
    """
    _save(path, config.to_dict(), model, state)


def load_checkpoint(path: Path) -> tuple[MPTConfig, nn.Module, dict[str, Any]]:
    """Read what `save_checkpoint` wrote.

    Returns:
        The configuration, the network and the further entries.

    Raises:
        InvalidWeights: The file is missing, damaged or no checkpoint.
    """
    configs: list[MPTConfig] = []

    def build(config: Mapping[str, Any]) -> nn.Module:
        configs.append(MPTConfig.from_dict(config))
        return create_model(configs[0])

    model, state = _load(path, build)
    return configs[0], model, state


def save_planner(path: Path, model: MPNet | NextNetwork, **state: Any) -> None:
    """Store the network of a learned planner; arguments as those of `save_checkpoint`."""
    _save(path, model.config.to_dict(), model, state)


def load_mpnet(path: Path) -> tuple[MPNet, dict[str, Any]]:
    """Read MPNet's networks, and what was stored with them.

    Raises:
        InvalidWeights: The file is missing, damaged or no checkpoint of MPNet.
    """
    return _load(path, lambda config: MPNet(MPNetConfig.from_dict(config)))


def load_next(path: Path) -> tuple[NextNetwork, dict[str, Any]]:
    """Read NEXT's network, and what was stored with it.

    Raises:
        InvalidWeights: The file is missing, damaged or no checkpoint of NEXT.
    """
    return _load(path, lambda config: NextNetwork(NextConfig.from_dict(config)))


def architecture_of(path: Path) -> str:
    """What a checkpoint holds: "mpnet", "next", or "" for all else, a damaged file included."""
    try:
        config = _read(path)["config"]
        return str(config.get("architecture", ""))
    except (InvalidWeights, AttributeError, LookupError, TypeError):
        return ""


def _save(path: Path, config: dict[str, Any], model: nn.Module, state: dict[str, Any]) -> None:
    content = {"config": config, "model": model.state_dict(), **state}
    path.parent.mkdir(parents=True, exist_ok=True)
    with whole_file(path) as file:
        torch.save(content, file)


def _load(
    path: Path, build: Callable[[Mapping[str, Any]], _Model]
) -> tuple[_Model, dict[str, Any]]:
    content = _read(path)
    try:
        model = build(content.pop("config"))
        model.load_state_dict(content.pop("model"))
    except (AttributeError, LookupError, RuntimeError, TypeError, ValueError) as error:
        raise InvalidWeights(f"{path} is no usable checkpoint: {error}") from error
    return model, content


def _read(path: Path) -> dict[str, Any]:
    try:
        content: dict[str, Any] = torch.load(path, map_location="cpu", weights_only=True)
    except FileNotFoundError:
        raise InvalidWeights(f"no checkpoint at {path}") from None
    except (
        AttributeError,
        EOFError,
        LookupError,  # IndexError is what PyTorch raises for some files that are no checkpoint
        OSError,
        RuntimeError,
        TypeError,
        ValueError,
        pickle.UnpicklingError,
    ) as error:
        raise InvalidWeights(f"{path} is no usable checkpoint: {error}") from error
    return content
