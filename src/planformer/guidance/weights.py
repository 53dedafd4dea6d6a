"""Find weights and read the card beside them."""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from planformer.encoding import NetworkScale
from planformer.errors import InvalidParameter, InvalidWeights, UnknownGuide, WeightsMismatch

SHIPPED = Path(__file__).resolve().parent.parent / "weights"

ALIASES = {"mpt": "mpt_small.forest_maze_indoor", "mpt-dubins": "mpt_dubins.forest_indoor"}
"""Short names for the recommended weights."""

CARD_VERSION = 1


@dataclass(frozen=True)
class Weights:
    """An .onnx file that fits its card.

    Attributes:
        model: The file's content.
        scale: Geometry of the network's input and output.
        card: The whole card.
    """

    model: bytes
    scale: NetworkScale
    card: dict[str, Any]

    @property
    def name(self) -> str:
        """The weights' own name, architecture.tag."""
        return str(self.card.get("name", "unnamed"))


def guide_names() -> list[str]:
    """Names of the shipped weights, aliases first."""
    names = sorted(path.stem for path in SHIPPED.glob("*.onnx"))
    return [*(alias for alias, name in ALIASES.items() if name in names), *names]


def weights_path(guide: str) -> Path:
    """The .onnx file of a shipped name, or the given .onnx file.

    Raises:
        UnknownGuide: No shipped weights have the name and no such file exists.
    """
    path = Path(guide) if guide.endswith(".onnx") else SHIPPED / f"{ALIASES.get(guide, guide)}.onnx"
    if ("/" in guide and not guide.endswith(".onnx")) or not path.is_file():
        raise UnknownGuide(
            f"unknown guide {guide!r}; valid: {', '.join(guide_names())}, the path of an existing "
            ".onnx file, or None"
        )
    return path


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
    try:
        scale = NetworkScale.from_dict(card["scale"])
    except (KeyError, TypeError, InvalidParameter) as error:
        raise InvalidWeights(f"{card_path} has no valid scale: {error}") from error
    return Weights(model, scale, card)
