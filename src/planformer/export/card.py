"""The card beside exported weights: what they are, how they were made, how good they are."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, fields
from pathlib import Path
from typing import Any

from planformer.encoding import NetworkScale
from planformer.errors import InvalidParameter, InvalidWeights
from planformer.models import MPTConfig, replace_file

CARD_VERSION = 1


@dataclass(frozen=True)
class WeightsCard:
    """Description of an .onnx file.

    Attributes:
        name: Name of the weights.
        network: Configuration of the network.
        scale: Geometry of its input and output.
        training: Settings of the training and of its data set, steps taken.
        accuracy: Validation metrics by kind of map.
        sha256: Hash of the .onnx file, hexadecimal.
        version: Version of the card's format.

    Raises:
        InvalidWeights: The version is not supported.
    """

    name: str
    network: MPTConfig
    scale: NetworkScale
    sha256: str
    training: dict[str, Any] = field(default_factory=dict)
    accuracy: dict[str, dict[str, float]] = field(default_factory=dict)
    version: int = CARD_VERSION

    def __post_init__(self) -> None:
        if self.version != CARD_VERSION:
            raise InvalidWeights(
                f"card version {self.version} is not supported; this release reads {CARD_VERSION}"
            )

    @property
    def robot(self) -> str:
        """Kind of robot: "point" in the plane, "dubins" with headings."""
        return "dubins" if self.scale.headings else "point"

    def write(self, path: Path) -> None:
        """Write the card as JSON; the file is replaced as a whole."""
        values = {
            **{f.name: getattr(self, f.name) for f in fields(self)},
            "robot": self.robot,
            "network": self.network.to_dict(),
            "scale": self.scale.to_dict(),
        }
        text = json.dumps(values, indent=2) + "\n"
        replace_file(path, lambda file: file.write(text.encode()))
