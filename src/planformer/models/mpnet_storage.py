"""MPNet's networks on disk."""

from __future__ import annotations

import pickle
from pathlib import Path
from typing import Any

import torch

from planformer.errors import InvalidWeights
from planformer.files import whole_file
from planformer.models.mpnet import MPNet, MPNetConfig


def save_mpnet(path: Path, model: MPNet, **state: Any) -> None:
    """Store a network with its configuration and whatever belongs to its training.

    Args:
        path: The file to replace; its folder is created.
        model: The network.
        **state: Further entries: tensors, numbers, strings and containers of them.
    """
    content = {"config": model.config.to_dict(), "model": model.state_dict(), **state}
    path.parent.mkdir(parents=True, exist_ok=True)
    with whole_file(path) as file:
        torch.save(content, file)


def load_mpnet(path: Path) -> tuple[MPNet, dict[str, Any]]:
    """Read what `save_mpnet` wrote.

    Returns:
        The network and the further entries.

    Raises:
        InvalidWeights: The file is missing, damaged or no checkpoint of MPNet.
    """
    try:
        content = torch.load(path, map_location="cpu", weights_only=True)
        model = MPNet(MPNetConfig.from_dict(content.pop("config")))
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
        raise InvalidWeights(f"{path} is no usable checkpoint of MPNet: {error}") from error
    return model, content
