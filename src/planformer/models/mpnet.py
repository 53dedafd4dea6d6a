"""The networks of MPNet: one encodes a map, the other steps from a state towards a goal.

Qureshi, Miao, Simeonov and Yip, Motion Planning Networks, T-RO 2020, with the sizes of the
variant that *Motion Planning Transformers* (Johnson et al.) compares with.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields
from itertools import pairwise
from typing import Any

import torch
from torch import Tensor, nn

from planformer.encoding.scale import NetworkScale, QueryKind
from planformer.errors import InvalidParameter

_KERNELS = (7, 5, 3)


@dataclass(frozen=True)
class MPNetConfig:
    """Sizes of MPNet's networks.

    Attributes:
        channels: Channels of the encoder's convolutions of 7, 5 and 3 pixels.
        grid: Side in cells to which a map's features are pooled, whatever the map's size.
        latent: Numbers that describe a map.
        widths: Hidden widths of the planning network.
        dropout: Probability of dropout in its hidden layers but the last, in training and in
            planning.
        resolution: Side in metres of the map's pixels.

    Raises:
        InvalidParameter: A value is out of range.
    """

    channels: tuple[int, ...] = (8, 16, 32)
    grid: int = 12
    latent: int = 128
    widths: tuple[int, ...] = (1280, 1024, 896, 768, 512, 384, 256, 256, 128, 64, 32)
    dropout: float = 0.5
    resolution: float = 0.05

    def __post_init__(self) -> None:
        for name in ("channels", "widths"):
            object.__setattr__(self, name, tuple(getattr(self, name)))
        if len(self.channels) != len(_KERNELS):
            raise InvalidParameter(f"channels must be {len(_KERNELS)} numbers; got {self.channels}")
        if len(self.widths) < 2:
            raise InvalidParameter(f"widths must be two or more numbers; got {self.widths}")
        if min(*self.channels, *self.widths, self.grid, self.latent) < 1:
            raise InvalidParameter(f"all sizes must be >= 1; got {self}")
        if not 0 <= self.dropout < 1:
            raise InvalidParameter(f"dropout must be in [0, 1); got {self.dropout}")
        if not (math.isfinite(self.resolution) and self.resolution > 0):
            raise InvalidParameter(f"resolution must be finite and > 0 m; got {self.resolution}")

    @property
    def scale(self) -> NetworkScale:
        """The geometry of the map that the encoder sees."""
        return NetworkScale(
            self.resolution,
            stride=1,
            patch=1,
            anchor_offset=0,
            query=QueryKind.SQUARE,
            query_stride=1,
        )

    @property
    def units(self) -> int:
        """Number of hidden units that dropout may drop."""
        return sum(self.widths[:-1])

    def to_dict(self) -> dict[str, Any]:
        """The configuration as JSON-compatible values."""
        return {"architecture": "mpnet", **asdict(self)}

    @classmethod
    def from_dict(cls, values: Mapping[str, Any]) -> MPNetConfig:
        """The inverse of `to_dict`.

        Raises:
            InvalidParameter: It is of another architecture, a key is unknown or a value out of
                range.
        """
        values = dict(values)
        if (name := values.pop("architecture", None)) != "mpnet":
            raise InvalidParameter(f"architecture must be 'mpnet'; got {name!r}")
        known = [field.name for field in fields(cls)]
        if unknown := sorted(set(values) - set(known)):
            raise InvalidParameter(f"unknown configuration keys {unknown}; valid are {known}")
        return cls(**values)


class MPNet(nn.Module):
    """Map encoder and planning network.

    Coordinates go from -1 to 1 over the map along both axes. Dropout is the planner's only
    randomness, so its random numbers are an input: a query's seed then fixes the plan.

    Args:
        config: Sizes of the networks.
    """

    def __init__(self, config: MPNetConfig) -> None:
        super().__init__()
        self.config = config
        layers: list[nn.Module] = []
        for (before, after), kernel in zip(pairwise((1, *config.channels)), _KERNELS, strict=True):
            layers += [
                nn.Conv2d(before, after, kernel, padding=kernel // 2),
                nn.MaxPool2d(3, ceil_mode=True),  # leaves a pixel of the smallest map
                nn.PReLU(),
            ]
        self.convolutions = nn.Sequential(*layers)
        self.latent = nn.Linear(config.channels[-1] * config.grid**2, config.latent)
        self.hidden = nn.ModuleList(
            nn.Linear(before, after)
            for before, after in pairwise((config.latent + 4, *config.widths))
        )
        self.activations = nn.ModuleList(nn.PReLU() for _ in config.widths)
        self.output = nn.Linear(config.widths[-1], 2)

    def encode(self, occupancy: Tensor) -> Tensor:
        """Describe maps.

        Args:
            occupancy: (B, 1, H, W) float, 1 = blocked; any H and W.

        Returns:
            (B, latent).
        """
        # The convolutions pad with zeros: what lies beyond the map is not free.
        features = _area_pooled(self.convolutions(1.0 - occupancy), self.config.grid)
        latent: Tensor = self.latent(features.flatten(1))
        return latent

    def forward(self, latent: Tensor, current: Tensor, goal: Tensor, noise: Tensor) -> Tensor:
        """Predict the next waypoints.

        Args:
            latent: (B, latent) from `encode`.
            current: (B, 2) states (x, y).
            goal: (B, 2) states to reach.
            noise: (B, units) uniform random numbers in [0, 1), which say what dropout drops.

        Returns:
            (B, 2) states, each coordinate in [-1, 1].
        """
        kept = (noise >= self.config.dropout).to(noise.dtype) / (1.0 - self.config.dropout)
        scales = kept.split(self.config.widths[:-1], dim=1)  # type: ignore[no-untyped-call]
        values = torch.cat([latent, current, goal], dim=1)
        *dropped, last = zip(self.hidden, self.activations, strict=True)
        for (layer, activation), scale in zip(dropped, scales, strict=True):
            values = activation(layer(values)) * scale
        layer, activation = last
        return torch.tanh(self.output(activation(layer(values))))


def _area_pooled(features: Tensor, cells: int) -> Tensor:
    """(B, C, cells, cells) means of (B, C, H, W) over equal parts of the map, of any size.

    Unlike PyTorch's adaptive pooling its parts are of exactly the same size, by sharing pixels
    between them, and it exists in ONNX for sizes that are not known in advance.
    """
    height, width = features.shape[-2:]
    return _shares(height, cells, features) @ features @ _shares(width, cells, features).T


def _shares(size: int, cells: int, like: Tensor) -> Tensor:
    """(cells, size): the share that each of `size` pixels has in each of the equal parts."""
    first = torch.arange(cells, dtype=torch.float32, device=like.device)[:, None] * size / cells
    pixel = torch.arange(size, dtype=torch.float32, device=like.device)[None, :]
    overlap = torch.minimum(first + size / cells, pixel + 1) - torch.maximum(first, pixel)
    return overlap.clamp(min=0.0) * cells / size
