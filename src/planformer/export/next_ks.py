"""Export of NEXT's network for ONNX Runtime."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import torch
from torch import Tensor, nn

from planformer.errors import MissingExtra
from planformer.export.graph import translated
from planformer.export.onnx import Exported, onnx_file, write_weights
from planformer.models.next_ks import NextNetwork
from planformer.models.storage import load_next

CHECKED_COUNTS = (1, 10, 32)
"""Numbers of states for which both are compared."""

_INPUTS = ("free", "goal", "context", "states")
_OUTPUTS = ("plan", "mean", "value")


class DeployedNext(nn.Module):
    """Both stages of the network side by side, so that one file holds them.

    Args:
        network: The network.
    """

    def __init__(self, network: NextNetwork) -> None:
        super().__init__()
        self.network = network

    def forward(
        self, free: Tensor, goal: Tensor, context: Tensor, states: Tensor
    ) -> tuple[Tensor, Tensor, Tensor]:
        """Plan on a map, and evaluate states in the context of an earlier plan; see `NextNetwork`.

        Args:
            free: (1, w, w) float32.
            goal: (1, 2) float32.
            context: (1, width, w, w) float32.
            states: (1, N, 2) float32.

        Returns:
            (1, width, w, w), (1, N, 2) and (1, N) float32.
        """
        return self.network.plan(free, goal), *self.network.evaluate(context, states)


def export_next(checkpoint: str | Path, path: str | Path, *, name: str | None = None) -> Exported:
    """Export a checkpoint of NEXT's network to one .onnx file with a card.

    Nothing is written unless ONNX Runtime reproduces PyTorch for all `CHECKED_COUNTS` of states.

    Args:
        checkpoint: A file that `planformer.training.next_ks.train_next` wrote.
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
    network, stored = load_next(Path(checkpoint))
    deployed = DeployedNext(network).eval()
    try:
        content = to_onnx(deployed)
        difference = largest_difference(content, deployed)
    except ModuleNotFoundError as error:
        raise MissingExtra(error.name or "onnx", "train") from error
    return write_weights(path, content, difference, name, _facts(network, stored))


def to_onnx(deployed: DeployedNext) -> bytes:
    """Translate the network to one ONNX graph for any number of states.

    Args:
        deployed: The network on the CPU.

    Returns:
        The serialised model; inputs "free", "goal", "context" and "states", outputs "plan", the
        context of later evaluations, "mean" and "value".
    """
    return translated(
        deployed,
        example_inputs(deployed, 10),
        input_names=_INPUTS,
        output_names=_OUTPUTS,
        dynamic_axes={
            "free": {1: "rows", 2: "columns"},
            **{name: {2: f"{name}_rows", 3: f"{name}_columns"} for name in ("context", "plan")},
            **{name: {1: "count"} for name in ("states", "mean", "value")},
        },
    )


def example_inputs(deployed: DeployedNext, count: int, *, seed: int = 0) -> tuple[Tensor, ...]:
    """Random inputs with `count` states."""
    config, generator = deployed.network.config, torch.Generator().manual_seed(seed)
    square = (config.side, config.side)
    shapes = ((1, *square), (1, 2), (1, config.width, *square), (1, count, 2))
    free, goal, context, states = (torch.rand(shape, generator=generator) for shape in shapes)
    return free, 2 * goal - 1, 2 * context - 1, 2 * states - 1


def largest_difference(content: bytes, deployed: DeployedNext) -> float:
    """Compare ONNX Runtime with PyTorch on random inputs.

    Args:
        content: The serialised ONNX model.
        deployed: The network that it was made from.

    Returns:
        The largest absolute difference of an output, in parts of its largest number where that
        exceeds 1. NaN if there is one.
    """
    import onnxruntime

    session = onnxruntime.InferenceSession(content, providers=["CPUExecutionProvider"])
    differences = [0.0]
    for seed, count in enumerate(CHECKED_COUNTS):
        inputs = example_inputs(deployed, count, seed=seed)
        feed = {name: value.numpy() for name, value in zip(_INPUTS, inputs, strict=True)}
        with torch.no_grad():
            expected = deployed(*inputs)
        for of_onnx, of_torch in zip(session.run(_OUTPUTS, feed), expected, strict=True):
            size = max(1.0, float(of_torch.abs().max()))
            differences.append(float(np.abs(of_onnx - of_torch.numpy()).max()) / size)
    return float(np.max(differences))


def _facts(network: NextNetwork, stored: dict[str, Any]) -> dict[str, Any]:
    """What a card says of NEXT's network."""
    history = stored.get("history") or [{}]
    errors = ("loss", "step_error", "value_error")
    return {
        "robot": "point",
        "planner": "NEXT-KS",
        "network": network.config.to_dict(),
        "training": {key: stored.get(key) for key in ("training", "data", "step", "seconds")},
        "validation": {key: history[-1].get(key) for key in errors},
    }
