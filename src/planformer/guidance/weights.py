"""Find the weights of a region proposer."""

from __future__ import annotations

from pathlib import Path

from planformer.encoding import NetworkScale
from planformer.errors import InvalidParameter, InvalidWeights, UnknownGuide
from planformer.robots import DubinsCar, Robot
from planformer.weights import SHIPPED, Weights

ALIASES = {
    "mpt": "mpt_small.forest_maze_indoor",
    "mpt-dubins": "mpt_dubins.forest_indoor",
    "mpt-paper": "mpt_paper_small.forest_maze_indoor",
    "mpt-paper-fixed-encoding": "mpt_paper_small_fixed_encoding.forest_maze_indoor",
    "unet": "unet_small.forest_maze_indoor",
}
"""Short names of weights: the recommended ones for a point robot and a car, then those of the
paper's architectures, which the tables compare with."""


def guide_names() -> list[str]:
    """Names of the shipped weights, aliases first."""
    names = sorted(path.stem for path in SHIPPED.glob("*.onnx"))
    return [*(alias for alias, name in ALIASES.items() if name in names), *names]


def default_guide(robot: Robot) -> str:
    """Name of the weights recommended for a robot: those for cars know headings."""
    return "mpt-dubins" if isinstance(robot, DubinsCar) else "mpt"


def weights_path(guide: str) -> Path:
    """The .onnx file of a shipped name, or the given .onnx file.

    Raises:
        UnknownGuide: No shipped weights have the name and no such file exists.
    """
    path = Path(guide) if guide.endswith(".onnx") else SHIPPED / f"{ALIASES.get(guide, guide)}.onnx"
    if ("/" in guide and not guide.endswith(".onnx")) or not _is_file(path):
        raise UnknownGuide(
            f"unknown guide {guide!r}; valid: {', '.join(guide_names())}, the path of an existing "
            ".onnx file, or None"
        )
    return path


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except OSError:  # too long a name, or in a folder that is another user's
        return False


def scale_of(weights: Weights) -> NetworkScale:
    """Geometry of the network's input and output, from the card.

    Raises:
        InvalidWeights: The card has none: the weights are no region proposer's, or damaged.
    """
    try:
        return NetworkScale.from_dict(weights.card["scale"])
    except (KeyError, TypeError, InvalidParameter) as error:
        card = weights.path.with_suffix(".json")
        raise InvalidWeights(f"{card} has no valid scale: {error}") from error
