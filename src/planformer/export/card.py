"""The card beside exported weights: what they are, how they were made, how good they are."""

from __future__ import annotations

import hashlib
import json
import subprocess
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from planformer.models import PRESETS, MPTConfig
from planformer.weights import CARD_VERSION


def make_card(weights: bytes, name: str, facts: Mapping[str, Any]) -> bytes:
    """The JSON text that describes an .onnx file.

    Its first keys: ``version`` of the format; ``name``; ``sha256`` of the .onnx file; ``commit`` of
    the source they were exported with, null outside a checkout.

    Args:
        weights: Content of the .onnx file.
        name: Name of the weights.
        facts: Further keys.
    """
    card = {
        "version": CARD_VERSION,
        "name": name,
        "sha256": hashlib.sha256(weights).hexdigest(),
        "commit": _commit(),
        **facts,
    }
    return (json.dumps(card, indent=2, allow_nan=False) + "\n").encode()


def proposer_facts(
    network: MPTConfig,
    *,
    training: Mapping[str, Any],
    accuracy: Mapping[str, Mapping[str, float]],
) -> dict[str, Any]:
    """What a card says of a region proposer.

    Its keys: ``robot``, "point" or "dubins"; ``preset``, null for a network of one's own;
    ``network``, see `MPTConfig.to_dict`; ``scale``, read by `NetworkScale.from_dict`; ``training``
    and ``accuracy`` as given.

    Args:
        network: Configuration of the network.
        training: Settings of the training, its data and its steps.
        accuracy: Validation metrics by kind of map.
    """
    return {
        "robot": "dubins" if network.headings else "point",
        "preset": next((known for known, made in PRESETS.items() if made == network), None),
        "network": network.to_dict(),
        "scale": network.scale.to_dict(),
        "training": dict(training),
        "accuracy": {kind: dict(values) for kind, values in accuracy.items()},
    }


def _commit() -> str | None:
    """The commit of the source tree that this module belongs to, None for an installed package."""
    source = Path(__file__).resolve().parent
    command = ["git", "-C", str(source), "ls-files", "--error-unmatch", Path(__file__).name]
    try:
        subprocess.run(command, check=True, capture_output=True)
        head = ["git", "-C", str(source), "rev-parse", "HEAD"]
        return subprocess.run(head, check=True, capture_output=True, text=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return None
