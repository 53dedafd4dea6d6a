"""Networks on disk."""

from __future__ import annotations

import pickle
from pathlib import Path
from typing import Any

import torch
from torch import nn

from planformer.errors import InvalidWeights
from planformer.files import whole_file
from planformer.models.config import MPTConfig
from planformer.models.create import create_model


def save_checkpoint(path: Path, config: MPTConfig, model: nn.Module, **state: Any) -> None:
    """Store a network with its configuration and whatever belongs to its training.

    Args:
        path: The file to replace; its folder is created.
        config: Configuration of the network.
        model: The network.
        **state: Further entries: tensors, numbers, strings and containers of them.
    """
    content = {"config": config.to_dict(), "model": model.state_dict(), **state}
    path.parent.mkdir(parents=True, exist_ok=True)
    with whole_file(path) as file:
        torch.save(content, file)


def load_checkpoint(path: Path) -> tuple[MPTConfig, nn.Module, dict[str, Any]]:
    """Read what `save_checkpoint` wrote.

    Returns:
        The configuration, the network and the further entries.

    Raises:
        InvalidWeights: The file is missing, damaged or no checkpoint.
    """
    try:
        content = torch.load(path, map_location="cpu", weights_only=True)
        config = MPTConfig.from_dict(content.pop("config"))
        model = create_model(config)
        model.load_state_dict(content.pop("model"))
    except FileNotFoundError:
        raise InvalidWeights(f"no checkpoint at {path}") from None
    except (
        AttributeError,
        EOFError,
        KeyError,
        OSError,
        RuntimeError,
        TypeError,
        ValueError,
        pickle.UnpicklingError,
    ) as error:
        raise InvalidWeights(f"{path} is no usable checkpoint: {error}") from error
    return config, model, content
