"""The Motion Planning Transformer as the paper describes it.

Johnson et al., Motion Planning Transformers: A Motion Planning Framework for Mobile Robots,
section III.A.
"""

from __future__ import annotations

import torch
import torch.nn.functional as F
from torch import Tensor, nn
from torch.utils.checkpoint import checkpoint

from planformer.models.config import TransformerBody
from planformer.models.proposal import Proposal

_NORM_EPS = 1e-6
_CONCENTRATION = 8.0
"""Length of all headings, since the paper's loss knows their direction alone; the yaw then strays
by 0.35 rad."""


class MotionPlanningTransformer(nn.Module):
    """Convolutions to tokens, a transformer encoder, a 1x1 convolution per output.

    Args:
        body: Sizes of the network.
        query_channels: Channels of the query beside the map.
        headings: Whether to predict headings.
    """

    def __init__(self, body: TransformerBody, query_channels: int, headings: bool) -> None:
        super().__init__()
        self.extractor = nn.Sequential(
            nn.Conv2d(1 + query_channels, 6, 5),
            nn.MaxPool2d(2),
            nn.ReLU(),
            nn.Conv2d(6, 16, 5),
            nn.MaxPool2d(2),
            nn.ReLU(),
            nn.Conv2d(16, body.width, 5, stride=5, padding=3),
        )
        self.positions = PositionEncoding(body)
        self.dropout = nn.Dropout(body.dropout)
        self.norm = nn.LayerNorm(body.width, eps=_NORM_EPS)
        self.layers = nn.ModuleList(EncoderLayer(body) for _ in range(body.layers))
        self.classifier = nn.Conv2d(body.width, 2, 1)
        self.orientation = nn.Conv2d(body.width, 2, 1) if headings else None

    def forward(self, occupancy: Tensor, query: Tensor) -> Proposal:
        """Propose a region.

        Args:
            occupancy: (B, 1, H, W) float, 1 = blocked; H and W multiples of 20.
            query: (B, C, H, W) float.

        Returns:
            The proposal, with the anchor of token (r, c) at pixel (20 r + 4, 20 c + 4).
        """
        features = self.extractor(torch.cat([occupancy, query], dim=1))
        tokens = (features + self.positions(features)).flatten(2).transpose(1, 2)
        tokens = self.norm(self.dropout(tokens))
        for layer in self.layers:
            tokens = layer(tokens)
        encoded = tokens.transpose(1, 2).reshape(features.shape)
        classes = self.classifier(encoded)
        # The difference of two classes' logits is the log-odds of the softmax.
        logits = classes[:, 1:] - classes[:, :1]
        return Proposal(logits, self._heading(encoded))

    def _heading(self, encoded: Tensor) -> Tensor | None:
        if self.orientation is None:
            return None
        return _CONCENTRATION * F.normalize(self.orientation(encoded), dim=1)


class PositionEncoding(nn.Module):
    """Sinusoids of a token's place in a table of H_max x H_max (equations 1 and 2).

    Fixed, the place of token (r, c) is r * w + c. Shifted, it is
    (r + shift_r) * H_max + c + shift_c: in training with a random shift per map that keeps the
    map inside the table, otherwise with none. A map wider than the table gets rows of its own
    width, so that no two tokens share a place.
    """

    def __init__(self, body: TransformerBody) -> None:
        super().__init__()
        self.table, self.shifted = body.table, body.shift_positions
        exponents = torch.arange(body.width, dtype=torch.float64) / body.width
        self.register_buffer("frequencies", (10000.0**-exponents).float(), persistent=False)

    def forward(self, features: Tensor) -> Tensor:
        """(B or 1, d, h, w) encodings for (B, d, h, w) features."""
        ones = torch.ones_like(features[:1, 0], dtype=torch.float32)
        row, col = ones.cumsum(1) - 1, ones.cumsum(2) - 1
        width = col.amax() + 1
        if not self.shifted:
            return self._encode(row * width + col)
        if self.training:
            row, col = (self._shift(axis, len(features)) for axis in (row, col))
        return self._encode(row * width.clamp(min=self.table) + col)

    def _shift(self, axis: Tensor, count: int) -> Tensor:
        room = max(self.table - int(axis.amax()), 1)
        return axis + torch.randint(room, (count, 1, 1), device=axis.device)

    def _encode(self, place: Tensor) -> Tensor:
        angles = place[:, None] * self.get_buffer("frequencies")[:, None, None]
        pairs = torch.stack([angles[:, 0::2].sin(), angles[:, 1::2].cos()], dim=2)
        return pairs.flatten(1, 2)


class EncoderLayer(nn.Module):
    """Multi-head self-attention and an MLP, each with dropout, residual and LayerNorm after it."""

    def __init__(self, body: TransformerBody) -> None:
        super().__init__()
        self.checkpointing = body.checkpointing
        self.attention = SelfAttention(body)
        self.attention_norm = nn.LayerNorm(body.width, eps=_NORM_EPS)
        self.mlp = nn.Sequential(
            nn.Linear(body.width, body.feed_forward),
            nn.ReLU(),
            nn.Linear(body.feed_forward, body.width),
            nn.Dropout(body.dropout),
        )
        self.mlp_norm = nn.LayerNorm(body.width, eps=_NORM_EPS)

    def forward(self, tokens: Tensor) -> Tensor:
        """(B, n, d) to (B, n, d)."""
        if self.checkpointing and self.training:
            mixed = checkpoint(self.attention, tokens, use_reentrant=False)
        else:
            mixed = self.attention(tokens)
        tokens = self.attention_norm(tokens + mixed)
        output: Tensor = self.mlp_norm(tokens + self.mlp(tokens))
        return output


class SelfAttention(nn.Module):
    """Scaled dot-product attention with values narrower than keys."""

    def __init__(self, body: TransformerBody) -> None:
        super().__init__()
        self.heads, self.dropout_p = body.heads, body.dropout
        self.query = nn.Linear(body.width, body.heads * body.key_width, bias=False)
        self.key = nn.Linear(body.width, body.heads * body.key_width, bias=False)
        self.value = nn.Linear(body.width, body.heads * body.value_width, bias=False)
        self.output = nn.Linear(body.heads * body.value_width, body.width, bias=False)
        self.dropout = nn.Dropout(body.dropout)

    def forward(self, tokens: Tensor) -> Tensor:
        """(B, n, d) to (B, n, d)."""
        query, key, value = (
            layer(tokens).unflatten(2, (self.heads, -1)).transpose(1, 2)
            for layer in (self.query, self.key, self.value)
        )
        dropout = self.dropout_p if self.training else 0.0
        mixed = F.scaled_dot_product_attention(query, key, value, dropout_p=dropout)
        output: Tensor = self.dropout(self.output(mixed.transpose(1, 2).flatten(2)))
        return output
