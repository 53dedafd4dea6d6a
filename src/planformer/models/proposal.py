"""What every region proposal network returns."""

from __future__ import annotations

from typing import NamedTuple

from torch import Tensor


class Proposal(NamedTuple):
    """Output of a network for (B, 1, H, W) maps, one value a token.

    Attributes:
        logits: (B, 1, h, w) log-odds that a good path runs through the token's patch.
        heading: (B, 2, h, w) vector along the direction of travel, as long as the network is sure:
            its length is the concentration of a von Mises distribution. None in the plane.
        offset: (B, 2, h, w) way in metres from each anchor to the path. None if not predicted.
    """

    logits: Tensor
    heading: Tensor | None = None
    offset: Tensor | None = None
