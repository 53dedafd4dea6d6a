"""NEXT's network on disk."""

from __future__ import annotations

import pickle
from pathlib import Path
from typing import Any

import torch

from planformer.errors import InvalidWeights
from planformer.files import whole_file
from planformer.models.next_ks import NextConfig, NextNetwork


def save_next(path: Path, model: NextNetwork, **state: Any) -> None:
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


def load_next(path: Path) -> tuple[NextNetwork, dict[str, Any]]:
    """Read what `save_next` wrote.

    Returns:
        The network and the further entries.

    Raises:
        InvalidWeights: The file is missing, damaged or no checkpoint of NEXT.
    """
    try:
        content = torch.load(path, map_location="cpu", weights_only=True)
        model = NextNetwork(NextConfig.from_dict(content.pop("config")))
        model.load_state_dict(content.pop("model"))
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
        raise InvalidWeights(f"{path} is no usable checkpoint of NEXT: {error}") from error
    return model, content
