"""Export of trained networks for ONNX Runtime."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import torch
from numpy.typing import NDArray

from planformer.encoding import NetworkScale
from planformer.errors import InvalidWeights, MissingExtra
from planformer.export.card import make_card, proposer_facts
from planformer.export.graph import MAP, QUERY, DeployedProposer, example_inputs, to_onnx
from planformer.files import write_files
from planformer.models import load_checkpoint

TOLERANCE = 1e-4
"""Largest difference between ONNX Runtime and PyTorch: of a probability, a component of a heading
or an offset, or a planner's output in parts of its largest number."""

CHECKED_SIZES = ((480, 480), (240, 360), (360, 240), (780, 780), (20, 40))
"""Map sizes (H, W) in pixels at which both are compared."""


class Exported(NamedTuple):
    """The files of an export.

    Attributes:
        weights: The .onnx file.
        card: The .json card beside it.
        difference: Largest difference between ONNX Runtime and PyTorch that was seen.
    """

    weights: Path
    card: Path
    difference: float


def export(checkpoint: str | Path, path: str | Path, *, name: str | None = None) -> Exported:
    """Export a training's checkpoint to one .onnx file with a card.

    The weights are stored in float32: a compact network is a few MB, and half precision would
    shift probabilities by more than the tolerance. Nothing is written unless ONNX Runtime
    reproduces PyTorch at all `CHECKED_SIZES`.

    Args:
        checkpoint: A file that `planformer.training.train` wrote.
        path: The .onnx file to write, its folder is created; the card takes its name.
        name: Name of the weights; by default the file's.

    Returns:
        The files and the largest difference seen.

    Raises:
        InvalidWeights: The checkpoint is damaged, or the exported network differs.
        InvalidParameter: A file cannot be written.
        MissingExtra: onnx or ONNX Runtime is not installed.
    """
    path = onnx_file(path)
    network, model, stored = load_checkpoint(Path(checkpoint))
    deployed = DeployedProposer(model).eval()
    try:
        content = to_onnx(deployed, network.scale)
        difference = largest_difference(content, deployed, network.scale)
    except ModuleNotFoundError as error:
        raise MissingExtra(error.name or "onnx", "train") from error
    facts = proposer_facts(
        network,
        training={key: stored.get(key) for key in ("training", "data", "step", "seconds")},
        accuracy=_last_metrics(stored.get("history", [])),
    )
    return write_weights(path, content, difference, name, facts)


def onnx_file(path: str | Path) -> Path:
    """The file to export to.

    Raises:
        InvalidWeights: Its name does not end in .onnx.
    """
    path = Path(path)
    if path.suffix != ".onnx":
        raise InvalidWeights(f"weights are exported to a file named *.onnx; got {path}")
    return path


def write_weights(
    path: Path, content: bytes, difference: float, name: str | None, facts: Mapping[str, Any]
) -> Exported:
    """Write an exported network and its card; neither is replaced unless both can be.

    Args:
        path: The .onnx file to write, its folder is created; the card takes its name.
        content: The serialised ONNX model.
        difference: Largest difference between ONNX Runtime and PyTorch.
        name: Name of the weights; by default the file's.
        facts: What the card says of the network.

    Raises:
        InvalidWeights: The difference exceeds `TOLERANCE`; nothing is written.
        InvalidParameter: A file cannot be written.
    """
    if not difference <= TOLERANCE:
        raise InvalidWeights(
            f"the exported network differs from PyTorch's by {difference:.2g}; at most "
            f"{TOLERANCE} is allowed"
        )
    path.parent.mkdir(parents=True, exist_ok=True)
    card = path.with_suffix(".json")
    write_files({path: content, card: make_card(content, name or path.stem, facts)})
    return Exported(path, card, difference)


def largest_difference(content: bytes, deployed: DeployedProposer, scale: NetworkScale) -> float:
    """Compare ONNX Runtime with PyTorch on random inputs of all `CHECKED_SIZES`.

    Args:
        content: The serialised ONNX model.
        deployed: The network that it was made from, in evaluation mode.
        scale: The network's scale.

    Returns:
        The largest absolute difference of a probability, or of a component of a heading or an
        offset, the latter two over the vector's length where that exceeds 1. NaN if there is one.
    """
    import onnxruntime

    session = onnxruntime.InferenceSession(content, providers=["CPUExecutionProvider"])
    differences = [0.0]
    for seed, (height, width) in enumerate(CHECKED_SIZES):
        pixels, query = example_inputs(scale, height, width, batch=1 + seed % 2, seed=seed)
        actual = session.run(None, {MAP: pixels.numpy(), QUERY: query.numpy()})
        with torch.no_grad():
            expected = deployed(pixels, query)
        for of_onnx, of_torch in zip(actual, expected, strict=True):
            length = of_torch.norm(dim=1, keepdim=True).clamp(min=1)
            differences.append(_largest((of_onnx - of_torch.numpy()) / length.numpy()))
    return float(np.max(differences))


def _largest(difference: NDArray[np.float32]) -> float:
    return float(np.abs(difference).max())


def _last_metrics(history: list[dict[str, Any]]) -> dict[str, dict[str, float]]:
    """The metrics of the last validation by kind of map."""
    last = max((row["step"] for row in history), default=None)
    common = {"step", "seconds", "learning_rate", "train_loss", "kind"}
    return {
        row["kind"]: {k: v for k, v in row.items() if k not in common}
        for row in history
        if row["step"] == last
    }
