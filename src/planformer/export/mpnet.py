"""Export of MPNet's networks for ONNX Runtime."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import torch
from torch import Tensor, nn

from planformer.errors import MissingExtra
from planformer.export.graph import translated
from planformer.export.onnx import Exported, onnx_file, write_weights
from planformer.models.mpnet import MPNet
from planformer.models.storage import load_mpnet

CHECKED_SIZES = ((480, 480), (240, 365), (1, 1), (20, 90))
"""Map sizes (H, W) in pixels at which both are compared."""

_INPUTS = ("map", "latent", "current", "goal", "noise")
_OUTPUTS = ("encoding", "waypoint")
_LARGE = 1024
"""Numbers from which an array of weights is stored in half precision."""


class DeployedMPNet(nn.Module):
    """Both networks side by side, so that one file holds them; they share nothing.

    Args:
        network: The networks.
    """

    def __init__(self, network: MPNet) -> None:
        super().__init__()
        self.network = network

    def forward(
        self, occupancy: Tensor, latent: Tensor, current: Tensor, goal: Tensor, noise: Tensor
    ) -> tuple[Tensor, Tensor]:
        """Encode maps, and step from states towards goals; see `MPNet`.

        Args:
            occupancy: (M, 1, H, W) uint8, 1 = blocked.
            latent: (B, latent) float32.
            current: (B, 2) float32.
            goal: (B, 2) float32.
            noise: (B, units) float32.

        Returns:
            (M, latent) float32 and (B, 2) float32.
        """
        encoding = self.network.encode(occupancy.to(latent.dtype))
        return encoding, self.network(latent, current, goal, noise)


def export_mpnet(checkpoint: str | Path, path: str | Path, *, name: str | None = None) -> Exported:
    """Export a checkpoint of MPNet to one .onnx file with a card.

    The weights are rounded to half precision, which the dropout of a half of the units drowns;
    ONNX Runtime turns them into float32 when it loads the file. Nothing is written unless it
    reproduces PyTorch, with the same rounded weights, at all `CHECKED_SIZES`.

    Args:
        checkpoint: A file that `planformer.training.mpnet.train_mpnet` wrote.
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
    network, stored = load_mpnet(Path(checkpoint))
    for parameter in network.parameters():
        if parameter.numel() >= _LARGE:
            parameter.data = parameter.data.half().float()
    deployed = DeployedMPNet(network).eval()
    try:
        content = to_onnx(deployed)
        difference = largest_difference(content, deployed)
    except ModuleNotFoundError as error:
        raise MissingExtra(error.name or "onnx", "train") from error
    return write_weights(path, content, difference, name, _facts(network, stored))


def to_onnx(deployed: DeployedMPNet) -> bytes:
    """Translate both networks to one ONNX graph with dynamic batches and map sizes.

    Args:
        deployed: The networks on the CPU.

    Returns:
        The serialised model; inputs "map", "latent", "current", "goal" and "noise", outputs
        "encoding" and "waypoint".
    """
    content = translated(
        deployed,
        example_inputs(deployed, 100, 130),
        input_names=_INPUTS,
        output_names=_OUTPUTS,
        dynamic_axes={
            "map": {0: "maps", 2: "height", 3: "width"},
            "encoding": {0: "maps"},
            **{name: {0: "batch"} for name in (*_INPUTS[1:], "waypoint")},
        },
    )
    return _halved(content)


def example_inputs(
    deployed: DeployedMPNet, height: int, width: int, *, seed: int = 0
) -> tuple[Tensor, ...]:
    """Random inputs: two maps of `height` by `width` pixels, three states."""
    config, generator = deployed.network.config, torch.Generator().manual_seed(seed)
    pixels = torch.randint(2, (2, 1, height, width), generator=generator, dtype=torch.uint8)
    widths = (config.latent, 2, 2, config.units)
    return pixels, *(torch.rand((3, width), generator=generator) for width in widths)


def largest_difference(content: bytes, deployed: DeployedMPNet) -> float:
    """Compare ONNX Runtime with PyTorch on random inputs of all `CHECKED_SIZES`.

    Args:
        content: The serialised ONNX model.
        deployed: The networks that it was made from.

    Returns:
        The largest absolute difference of an output, of the encoding in parts of its largest
        number where that exceeds 1. NaN if there is one.
    """
    import onnxruntime

    session = onnxruntime.InferenceSession(content, providers=["CPUExecutionProvider"])
    differences = [0.0]
    for seed, (height, width) in enumerate(CHECKED_SIZES):
        inputs = example_inputs(deployed, height, width, seed=seed)
        feed = {name: value.numpy() for name, value in zip(_INPUTS, inputs, strict=True)}
        with torch.no_grad():
            expected = deployed(*inputs)
        for of_onnx, of_torch in zip(session.run(_OUTPUTS, feed), expected, strict=True):
            size = max(1.0, float(of_torch.abs().max()))
            differences.append(float(np.abs(of_onnx - of_torch.numpy()).max()) / size)
    return float(np.max(differences))


def _halved(content: bytes) -> bytes:
    """Store large arrays of weights in half precision, each with a cast behind it."""
    import onnx
    from onnx import numpy_helper

    model = onnx.load_from_string(content)
    casts = []
    for tensor in model.graph.initializer:
        values = numpy_helper.to_array(tensor)
        if values.dtype != np.float32 or values.size < _LARGE:
            continue
        name, stored = tensor.name, f"{tensor.name}.half"
        tensor.CopyFrom(numpy_helper.from_array(values.astype(np.float16), stored))
        casts.append(onnx.helper.make_node("Cast", [stored], [name], to=onnx.TensorProto.FLOAT))
    nodes = [*casts, *model.graph.node]
    del model.graph.node[:]
    model.graph.node.extend(nodes)
    serialised: bytes = model.SerializeToString()
    return serialised


def _facts(network: MPNet, stored: dict[str, Any]) -> dict[str, Any]:
    """What a card says of MPNet."""
    history = stored.get("history") or [{}]
    return {
        "robot": "point",
        "planner": "MPNet",
        "network": network.config.to_dict(),
        "scale": network.config.scale.to_dict(),
        "training": {key: stored.get(key) for key in ("training", "data", "step", "seconds")},
        "validation_loss": history[-1].get("validation_loss"),
    }
