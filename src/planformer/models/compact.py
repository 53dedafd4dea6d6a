"""A compact region proposal network that a CPU runs in milliseconds and trains in an hour.

The map is packed into the channels of the query's coarser grid, and convolutions with strides make
the tokens. Depthwise convolutions (as in ConvNeXt, Liu et al., CVPR 2022) then mix neighbouring
tokens, and an attention block with rotary positions along both axes (Su et al., RoFormer, 2021), if
there is one, mixes the rest. Both depend on relative positions alone, so a network trained on one
map size serves others.
"""

from __future__ import annotations

import torch
import torch.nn.functional as F
from torch import Tensor, nn

from planformer.encoding.scale import NetworkScale
from planformer.models.config import CompactBody
from planformer.models.proposal import Proposal

_ROTARY_PERIODS = 100.0
"""Ratio of the longest to the shortest rotary wavelength; the shortest is 2 pi tokens."""


class CompactMPT(nn.Module):
    """Stem, blocks, a linear head.

    Args:
        body: Sizes of the network.
        scale: Geometry of its input and output.
    """

    def __init__(self, body: CompactBody, scale: NetworkScale) -> None:
        super().__init__()
        side = scale.query_stride
        reduction = scale.stride // side
        self.side = side
        # Most of the time would go into convolutions at the query's own resolution.
        self.stem = nn.Sequential(
            nn.Conv2d(side**2 + scale.query_channels, body.stem, 2, stride=2),
            nn.ReLU(),
            nn.Conv2d(body.stem, body.stem, 3, padding=1),
            nn.ReLU(),
            nn.Conv2d(body.stem, body.width, reduction // 2, stride=reduction // 2),
        )
        self.blocks = nn.Sequential(*_blocks(body))
        self.norm = ChannelNorm(body.width)
        self.headings, self.offsets = scale.headings, scale.offsets
        self.head = nn.Conv2d(body.width, 1 + 2 * scale.headings + 2 * scale.offsets, 1)

    def forward(self, occupancy: Tensor, query: Tensor) -> Proposal:
        """Propose a region.

        Args:
            occupancy: (B, 1, H, W) float, 1 = blocked; H and W multiples of 20.
            query: (B, C, H / 5, W / 5) float.

        Returns:
            The proposal, with the anchor of token (r, c) at pixel (20 r + 10, 20 c + 10).
        """
        tokens = self.stem[1:](self._first_layer(occupancy, query))
        output = self.head(self.norm(self.blocks(tokens)))
        return Proposal(
            output[:, :1],
            heading=output[:, 1:3] if self.headings else None,
            offset=output[:, -2:] if self.offsets else None,
        )

    def _first_layer(self, occupancy: Tensor, query: Tensor) -> Tensor:
        """The stem's first convolution, of the map packed into query pixels, and of the query.

        To pack the map and to join both took a fourth of the network's time: the same sums are a
        convolution of the map with larger kernels and another of the query.
        """
        first, side = self.stem[0], self.side
        assert isinstance(first, nn.Conv2d)
        of_map, of_query = first.weight[:, : side**2], first.weight[:, side**2 :]
        from_map = F.conv2d(occupancy, F.pixel_shuffle(of_map, side), stride=2 * side)
        return from_map + F.conv2d(query, of_query, first.bias, stride=2)


def _blocks(body: CompactBody) -> list[nn.Module]:
    blocks: list[nn.Module] = [ConvolutionBlock(body) for _ in range(body.blocks)]
    if body.heads:
        blocks.insert((body.blocks + 1) // 2, AttentionBlock(body))
    return blocks


class ChannelNorm(nn.LayerNorm):
    """LayerNorm over the channels of (B, d, h, w)."""

    def forward(self, tokens: Tensor) -> Tensor:
        """(B, d, h, w) to (B, d, h, w)."""
        return super().forward(tokens.permute(0, 2, 3, 1)).permute(0, 3, 1, 2)


class ConvolutionBlock(nn.Module):
    """A depthwise 5x5 convolution and an MLP, with a residual connection."""

    def __init__(self, body: CompactBody) -> None:
        super().__init__()
        self.mix = nn.Conv2d(body.width, body.width, 5, padding=2, groups=body.width)
        self.norm = nn.LayerNorm(body.width)
        self.expand = nn.Linear(body.width, body.expansion * body.width)
        self.contract = nn.Linear(body.expansion * body.width, body.width)

    def forward(self, tokens: Tensor) -> Tensor:
        """(B, d, h, w) to (B, d, h, w)."""
        mixed = self.norm(self.mix(tokens).permute(0, 2, 3, 1))
        hidden = F.gelu(self.expand(mixed))
        change: Tensor = self.contract(hidden)
        return tokens + change.permute(0, 3, 1, 2)


class AttentionBlock(nn.Module):
    """Pre-norm self-attention within windows, with rotary positions and a residual connection."""

    def __init__(self, body: CompactBody) -> None:
        super().__init__()
        self.heads, self.window = body.heads, body.window
        self.norm = ChannelNorm(body.width)
        self.project = nn.Linear(body.width, 3 * body.width)
        self.output = nn.Linear(body.width, body.width)
        angles = _rotary_angles(body.window, body.width // body.heads)
        self.register_buffer("rotary_cos", angles.cos(), persistent=False)
        self.register_buffer("rotary_sin", angles.sin(), persistent=False)

    def forward(self, tokens: Tensor) -> Tensor:
        """(B, d, h, w) to (B, d, h, w)."""
        height, width = tokens.shape[-2:]
        beyond = (0, -width % self.window, 0, -height % self.window)
        windows = self._split(F.pad(self.norm(tokens), beyond))
        query, key, value = (
            part.unflatten(2, (self.heads, -1)).transpose(1, 2)
            for part in self.project(windows).chunk(3, dim=2)
        )
        mixed = F.scaled_dot_product_attention(
            self._rotate(query), self._rotate(key), value, attn_mask=self._mask(tokens, beyond)
        )
        change = self.output(mixed.transpose(1, 2).flatten(2))
        return tokens + self._join(change, height, width)

    def _mask(self, tokens: Tensor, beyond: tuple[int, int, int, int]) -> Tensor | None:
        """(B * windows, 1, 1, n) bool, False beyond the map; None where all is map."""
        if not (torch.onnx.is_in_onnx_export() or any(beyond)):
            return None
        inside = F.pad(torch.ones_like(tokens[:, :1]), beyond)
        return self._split(inside)[:, None, None, :, 0] > 0.5

    def _split(self, tokens: Tensor) -> Tensor:
        """(B, d, h, w) to (B * windows, window^2, d); h and w multiples of the window."""
        _, channels, height, width = tokens.shape
        side = self.window
        tiles = tokens.reshape(-1, channels, height // side, side, width // side, side)
        return tiles.permute(0, 2, 4, 3, 5, 1).reshape(-1, side * side, channels)

    def _join(self, windows: Tensor, height: int, width: int) -> Tensor:
        """The inverse of `_split`, without what lies beyond (height, width)."""
        side, channels = self.window, windows.shape[2]
        rows, cols = (height + side - 1) // side, (width + side - 1) // side
        tiles = windows.reshape(-1, rows, cols, side, side, channels).permute(0, 5, 1, 3, 2, 4)
        return tiles.reshape(-1, channels, rows * side, cols * side)[..., :height, :width]

    def _rotate(self, heads: Tensor) -> Tensor:
        """Rotate pairs of channels of (B, heads, n, k) by angles that grow with the position."""
        cos = self.get_buffer("rotary_cos").to(heads.dtype)
        sin = self.get_buffer("rotary_sin").to(heads.dtype)
        first, second = heads.chunk(2, dim=-1)
        return torch.cat([first * cos - second * sin, first * sin + second * cos], dim=-1)


def _rotary_angles(window: int, head_width: int) -> Tensor:
    """(window^2, head_width / 2) angles: half of them grow with the row, half with the column."""
    count = head_width // 4
    frequencies = _ROTARY_PERIODS ** -(torch.arange(count) / count)
    along = torch.arange(window)[:, None] * frequencies
    rows = along[:, None].expand(window, window, count)
    cols = along[None, :].expand(window, window, count)
    return torch.cat([rows, cols], dim=-1).reshape(window * window, 2 * count)
