"""The network of NEXT: it plans on a coarse map and then says where to go from any state.

Chen, Dai, Lin, Ye, Liu and Song, Learning to Plan in High Dimensions via Neural
Exploration-Exploitation Trees, ICLR 2020: attention-based state embedding, a planning module in
the manner of value iteration, and a head with policy and value.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields
from itertools import pairwise
from typing import Any

import torch
import torch.nn.functional as F
from torch import Tensor, nn

from planformer.errors import InvalidParameter

_CELL_WIDTHS = (16, 16, 32, 32, 64, 1)
_DEPTH_WIDTHS = (2, 64)
_HEAD_WIDTHS = (128, 64, 3)
_GOAL_SCALE = 4.0
_FORGET_BIAS = 3.0
"""The memory keeps exp(-0.05) of itself in each iteration at first."""


@dataclass(frozen=True)
class NextConfig:
    """Sizes of NEXT's network.

    Attributes:
        side: Side w in cells of the square map that it plans on. Published were 15 and 16; the
            1.6 m between a maze's walls need more on 24 m.
        depth: Layers of the embedding between which the attention of a state chooses.
        features: Features of a state, from which policy and value are read.
        iterations: Steps of the planning module; what it knows of the goal spreads by one cell in
            each.

    Raises:
        InvalidParameter: A value is not a number >= 1.
    """

    side: int = 24
    depth: int = 8
    features: int = 8
    iterations: int = 20

    def __post_init__(self) -> None:
        for field in fields(self):
            if not getattr(self, field.name) >= 1:
                raise InvalidParameter(
                    f"{field.name} must be >= 1; got {getattr(self, field.name)}"
                )

    @property
    def width(self) -> int:
        """Channels of the planning module."""
        return self.depth * self.features

    def to_dict(self) -> dict[str, Any]:
        """The configuration as JSON-compatible values."""
        return {"architecture": "next", **asdict(self)}

    @classmethod
    def from_dict(cls, values: Mapping[str, Any]) -> NextConfig:
        """The inverse of `to_dict`.

        Raises:
            InvalidParameter: It is of another architecture, a key is unknown or a value out of
                range.
        """
        values = dict(values)
        if (name := values.pop("architecture", None)) != "next":
            raise InvalidParameter(f"architecture must be 'next'; got {name!r}")
        known = [field.name for field in fields(cls)]
        if unknown := sorted(set(values) - set(known)):
            raise InvalidParameter(f"unknown configuration keys {unknown}; valid are {known}")
        return cls(**values)


class StateAttention(nn.Module):
    """Where on the map a state is: weights over the cells, times weights over the depth.

    Args:
        config: Sizes of the network.
    """

    def __init__(self, config: NextConfig) -> None:
        super().__init__()
        # Together the two are one layer on a state beside the centre of each cell.
        self.of_cell = nn.Linear(2, _CELL_WIDTHS[0])
        self.of_state = nn.Linear(2, _CELL_WIDTHS[0], bias=False)
        self.score = nn.Sequential(nn.ReLU(), *_layers(_CELL_WIDTHS))
        self.depth = nn.Sequential(*_layers((*_DEPTH_WIDTHS, config.depth)))

    def forward(self, states: Tensor, side: int) -> tuple[Tensor, Tensor]:
        """Attend to states.

        Args:
            states: (..., 2) in [-1, 1].
            side: Side w of the map in cells.

        Returns:
            (..., w * w) weights of the cells and (..., depth) weights of the depth; the weights of
            each kind sum to 1.
        """
        centres = _cell_centres(side, states)
        hidden = self.of_cell(centres) + self.of_state(states)[..., None, :]
        offset = (centres - states[..., None, :]) * (0.5 * side)
        # As one matrix: ONNX Runtime is faster then.
        scores = self.score(hidden.flatten(0, -2)).view(hidden.shape[:-1]).float()
        # Attention starts local, where the published one has to learn it.
        scores = scores - 2.0 * (offset * offset).sum(-1)
        return scores.softmax(-1), self.depth(states).float().softmax(-1)


class NextNetwork(nn.Module):
    """Plans on a map once, in `plan`; then `evaluate` is cheap for any number of states.

    All coordinates go from -1 to 1 over the square map.

    Args:
        config: Sizes of the network.
    """

    def __init__(self, config: NextConfig) -> None:
        super().__init__()
        self.config, width = config, config.width
        self.attention = StateAttention(config)
        self.encoder = nn.Conv2d(1 + config.depth, width, 3, padding=1)
        self.hidden = nn.Conv2d(width, width, 3, padding=1)
        self.cell = nn.Conv2d(width, width, 3, padding=1)
        self.spread = nn.Conv2d(width, width, 3, padding=1)
        self.update = nn.LSTMCell(width, width)
        self.head = nn.Sequential(*_layers((config.features, *_HEAD_WIDTHS)))
        self._initialise()

    @torch.no_grad()
    def _initialise(self) -> None:
        """Let map and goal reach the outputs from the beginning.

        PyTorch's defaults shrink what the goal does to the context to 1e-7 of it.
        """
        for layer in (self.encoder, self.hidden, self.cell, self.spread, *self.head):
            if isinstance(layer, nn.Conv2d | nn.Linear):
                nn.init.kaiming_normal_(layer.weight)
                layer.bias.zero_()  # type: ignore[union-attr]  # all of them have a bias
        width = self.config.width
        self.update.bias_hh[width : 2 * width] = _FORGET_BIAS

    def plan(self, free: Tensor, goal: Tensor) -> Tensor:
        """Plan on maps.

        Args:
            free: (B, w, w) float, the free part of each cell.
            goal: (B, 2) states to reach.

        Returns:
            (B, width, w, w) the context in which states are evaluated.
        """
        cells, depth = self.attention(goal, free.shape[-1])
        # Scaled for the goal to stand out as the map does: the weights sum to 1 over all cells.
        scale = _GOAL_SCALE * self.config.depth
        attended = scale * (depth[:, :, None] * cells[:, None, :]).unflatten(-1, free.shape[1:])
        encoded = F.relu(self.encoder(torch.cat([free[:, None], attended], dim=1)))
        hidden: Tensor = self.hidden(encoded)
        # The recurrent cell is the same at each place of the map.
        memory = _as_rows(self.cell(encoded))
        for _ in range(self.config.iterations):
            inputs = _as_rows(self.spread(hidden))
            rows, memory = self.update(inputs, (_as_rows(hidden), memory))
            hidden = rows.view(len(free), *free.shape[1:], -1).permute(0, 3, 1, 2)
        return hidden

    def evaluate(self, context: Tensor, states: Tensor) -> tuple[Tensor, Tensor]:
        """Say where to go from states, and how good they are.

        Args:
            context: (B, width, w, w) from `plan`.
            states: (B, N, 2).

        Returns:
            (B, N, 2) mean of the policy's next step in lengths of a step, and (B, N) value: minus
            the length of the way to the goal, in the coordinates of the states.
        """
        config = self.config
        cells, depth = self.attention(states, context.shape[-1])
        embedded = (cells @ context.flatten(2).transpose(1, 2)).unflatten(
            -1, (config.features, config.depth)
        )
        features = (embedded @ depth[..., None])[..., 0]
        mean, value = self.head(features).float().split((2, 1), dim=-1)
        return mean, value[..., 0]


def _layers(widths: tuple[int, ...]) -> list[nn.Module]:
    """Linear layers with ReLU between them."""
    layers: list[nn.Module] = []
    for before, after in pairwise(widths):
        layers += [nn.Linear(before, after), nn.ReLU()]
    return layers[:-1]


def _cell_centres(side: int, like: Tensor) -> Tensor:
    """(side * side, 2) centres (x, y) of the cells of a square map."""
    axis = (torch.arange(side, device=like.device) + 0.5) * (2.0 / side) - 1.0
    return torch.stack((axis.repeat(side), axis.repeat_interleave(side)), dim=-1)


def _as_rows(maps: Tensor) -> Tensor:
    """(B * w * w, C) of (B, C, w, w)."""
    return maps.permute(0, 2, 3, 1).flatten(0, 2)
