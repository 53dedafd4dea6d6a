"""Region proposal networks in PyTorch."""

from planformer.errors import MissingExtra

try:
    import torch as _torch  # noqa: F401
except ImportError as error:
    raise MissingExtra("torch", "train") from error

from planformer.models.config import (
    PRESETS,
    CompactBody,
    MPTConfig,
    TransformerBody,
    UNetBody,
    preset,
)
from planformer.models.create import create_model
from planformer.models.proposal import Proposal
from planformer.models.storage import load_checkpoint, save_checkpoint

__all__ = [
    "PRESETS",
    "CompactBody",
    "MPTConfig",
    "Proposal",
    "TransformerBody",
    "UNetBody",
    "create_model",
    "load_checkpoint",
    "preset",
    "save_checkpoint",
]
