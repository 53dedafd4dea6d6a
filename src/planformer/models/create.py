"""From a configuration to a network."""

from __future__ import annotations

from torch import nn

from planformer.models.compact import CompactMPT
from planformer.models.config import MPTConfig, TransformerBody, UNetBody, preset
from planformer.models.mpt import MotionPlanningTransformer
from planformer.models.unet import UNet


def create_model(config: str | MPTConfig) -> nn.Module:
    """Create a network with fresh weights.

    Args:
        config: A configuration, or the name of a preset.

    Returns:
        A module whose forward takes a map (B, 1, H, W) and a query (B, C, H/s, W/s), both float,
        and returns a `Proposal`; H and W are multiples of the scale's stride.

    Raises:
        InvalidParameter: No preset has this name.
    """
    if isinstance(config, str):
        config = preset(config)
    scale = config.scale
    if isinstance(config.body, TransformerBody):
        return MotionPlanningTransformer(config.body, scale.query_channels, config.headings)
    if isinstance(config.body, UNetBody):
        return UNet(config.body, scale.query_channels)
    return CompactMPT(config.body, scale)
