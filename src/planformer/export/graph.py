"""The network as deployments run it: raw map in, probabilities and headings out."""

from __future__ import annotations

import io
import warnings
from collections.abc import Mapping, Sequence

import torch
from torch import Tensor, nn

from planformer.encoding import NetworkScale

OPSET = 17
MAP, QUERY = "map", "query"
PROBABILITY, HEADING, OFFSET = "probability", "heading", "offset"


class DeployedProposer(nn.Module):
    """A network with its input and output conversions.

    Args:
        network: A network that returns a `Proposal`.
    """

    def __init__(self, network: nn.Module) -> None:
        super().__init__()
        self.network = network

    def forward(self, occupancy: Tensor, query: Tensor) -> tuple[Tensor, ...]:
        """Propose a region.

        Args:
            occupancy: (B, 1, H, W) uint8, 1 = blocked; H and W multiples of the stride.
            query: (B, C, H/s, W/s) float32.

        Returns:
            (B, 1, h, w) float32 probabilities and, where the network predicts them, (B, 2, h, w)
            float32 headings and offsets as in `Proposal`.
        """
        proposal = self.network(occupancy.to(query.dtype), query)
        optional = (proposal.heading, proposal.offset)
        predicted = (output for output in optional if output is not None)
        return torch.sigmoid(proposal.logits), *predicted


def output_names(scale: NetworkScale) -> list[str]:
    """Names of a network's outputs, in their order."""
    return [PROBABILITY, *[HEADING] * scale.headings, *[OFFSET] * scale.offsets]


def example_inputs(
    scale: NetworkScale, height: int, width: int, *, batch: int = 1, seed: int = 0
) -> tuple[Tensor, Tensor]:
    """Random inputs of a network, `height` by `width` pixels."""
    generator = torch.Generator().manual_seed(seed)
    map_shape = (batch, 1, height, width)
    pixels = torch.randint(2, map_shape, generator=generator, dtype=torch.uint8)
    side = scale.query_stride
    query_shape = (batch, scale.query_channels, height // side, width // side)
    return pixels, 2 * torch.rand(query_shape, generator=generator) - 1


def to_onnx(deployed: DeployedProposer, scale: NetworkScale) -> bytes:
    """Translate a network to ONNX with dynamic batch, height and width.

    Args:
        deployed: The network, in evaluation mode on the CPU.
        scale: Its scale.

    Returns:
        The serialised model; inputs "map" and "query", outputs as in `output_names`.
    """
    outputs = output_names(scale)
    inputs = example_inputs(scale, 12 * scale.stride, 15 * scale.stride)
    return translated(
        deployed,
        inputs,
        input_names=[MAP, QUERY],
        output_names=outputs,
        dynamic_axes={
            name: {0: "batch", 2: f"{name}_height", 3: f"{name}_width"}
            for name in (MAP, QUERY, *outputs)
        },
    )


def translated(
    module: nn.Module,
    inputs: tuple[Tensor, ...],
    *,
    input_names: Sequence[str],
    output_names: Sequence[str],
    dynamic_axes: Mapping[str, Mapping[int, str]],
) -> bytes:
    """The serialised ONNX model of a module.

    Args:
        module: The module on the CPU.
        inputs: Example inputs.
        input_names: Their names.
        output_names: Names of the outputs.
        dynamic_axes: Axes of inputs and outputs whose size may be another, by name.
    """
    file = io.BytesIO()
    with warnings.catch_warnings():
        # PyTorch's newer exporter needs onnxscript; the older one says that it is old.
        warnings.simplefilter("ignore", DeprecationWarning)
        warnings.simplefilter("ignore", torch.jit.TracerWarning)  # type: ignore[attr-defined]
        torch.onnx.export(
            module.eval(),  # the export restores this mode, of all parts
            inputs,
            file,  # type: ignore[arg-type]  # declared for paths, made for files too
            dynamo=False,
            opset_version=OPSET,
            input_names=list(input_names),
            output_names=list(output_names),
            dynamic_axes=dynamic_axes,
        )
    return file.getvalue()
