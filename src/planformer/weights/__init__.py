"""Shipped weights, and how a file of weights and the card beside it are read."""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from planformer.errors import InvalidWeights, WeightsMismatch

if TYPE_CHECKING:
    from onnxruntime import InferenceSession

SHIPPED = Path(__file__).resolve().parent
"""Folder of the region proposers' weights; those of learned planners lie in its `planners`."""

CARD_VERSION = 1


@dataclass(frozen=True)
class Weights:
    """An .onnx file that fits its card.

    Attributes:
        path: The file.
        model: Its content.
        card: The whole card.
    """

    path: Path
    model: bytes
    card: dict[str, Any]

    @property
    def name(self) -> str:
        """The weights' own name, architecture.tag."""
        return str(self.card.get("name", "unnamed"))


def read_weights(path: Path) -> Weights:
    """Read an .onnx file and the .json card beside it.

    Raises:
        InvalidWeights: A file cannot be read or the card is damaged.
        WeightsMismatch: The .onnx file is not the one that the card describes.
    """
    card_path = path.with_suffix(".json")
    try:
        model = path.read_bytes()
        card = json.loads(card_path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise InvalidWeights(f"cannot read the weights {path} and their card: {error}") from error
    if not isinstance(card, dict) or card.get("version") != CARD_VERSION:
        raise InvalidWeights(f"{card_path} is no card of version {CARD_VERSION}")
    if card.get("sha256") != hashlib.sha256(model).hexdigest():
        raise WeightsMismatch(
            f"{path} is not the file that {card_path.name} describes (sha256 differs): it is "
            "truncated or was replaced; export it again or reinstall planformer"
        )
    return Weights(path, model, card)


def changed_at(path: Path) -> tuple[int, int]:
    """When an .onnx file and its card were last changed, to load them again after that.

    Raises:
        InvalidWeights: One of them is missing.
    """
    try:
        return path.stat().st_mtime_ns, path.with_suffix(".json").stat().st_mtime_ns
    except (OSError, ValueError) as error:
        raise InvalidWeights(f"cannot read the weights {path} and their card: {error}") from error


def open_session(weights: Weights) -> InferenceSession:
    """What evaluates weights on the CPU, on one thread.

    More threads pay only while nothing else runs: two programs that both share a network out over
    the same two cores take nearly three times as long as on one thread each.

    Raises:
        InvalidWeights: ONNX Runtime cannot load the file.
    """
    import onnxruntime

    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = 1
    try:
        return onnxruntime.InferenceSession(
            weights.model, options, providers=["CPUExecutionProvider"]
        )
    except Exception as error:  # ONNX Runtime's exceptions share no public base class
        raise InvalidWeights(f"ONNX Runtime cannot load {weights.path}: {error}") from error
