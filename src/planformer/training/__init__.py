"""Training of the region proposal networks."""

import planformer.models  # noqa: F401  # says how to install PyTorch where it is missing
from planformer.training.config import Recipe, TrainConfig, config_for
from planformer.training.devices import is_first_process
from planformer.training.sources import open_paths
from planformer.training.train import Progress, TrainResult, train
from planformer.training.validation import validate

__all__ = [
    "Progress",
    "Recipe",
    "TrainConfig",
    "TrainResult",
    "config_for",
    "is_first_process",
    "open_paths",
    "train",
    "validate",
]
