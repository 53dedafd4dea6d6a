"""Networks on disk."""

from __future__ import annotations

import os
import pickle
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import IO, Any

import torch
from torch import nn

from planformer.errors import InvalidWeights
from planformer.models.config import MPTConfig
from planformer.models.create import create_model


def replace_file(path: Path, write: Callable[[IO[bytes]], object]) -> None:
    """Write a file so that at any time either the old or the whole new one is there.

    Args:
        path: Where to write; its folder is created.
        write: Receives a binary file to write to.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    descriptor, name = tempfile.mkstemp(prefix=f".{path.name}.", dir=path.parent)
    temporary = Path(name)
    try:
        with os.fdopen(descriptor, "wb") as file:
            write(file)
            file.flush()
            os.fsync(file.fileno())
        umask = os.umask(0)
        os.umask(umask)
        temporary.chmod(0o666 & ~umask)  # mkstemp makes files private
        temporary.replace(path)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise


def save_checkpoint(path: Path, config: MPTConfig, model: nn.Module, **state: Any) -> None:
    """Store a network with its configuration and whatever belongs to its training.

    Args:
        path: The file to replace.
        config: Configuration of the network.
        model: The network.
        **state: Further entries: tensors, numbers, strings and containers of them.
    """
    content = {"config": config.to_dict(), "model": model.state_dict(), **state}
    replace_file(path, lambda file: torch.save(content, file))


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
