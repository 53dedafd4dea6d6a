"""A U-Net that classifies each pixel: the paper's baseline among region proposals.

Ronneberger, Fischer and Brox, U-Net: Convolutional Networks for Biomedical Image Segmentation,
MICCAI 2015; the sizes are those of the paper's experiments, upsampling is bilinear.
"""

from __future__ import annotations

import itertools

import torch
import torch.nn.functional as F
from torch import Tensor, nn

from planformer.models.config import UNetBody
from planformer.models.proposal import Proposal


class UNet(nn.Module):
    """Convolutions at halved resolutions and back, with skip connections.

    Args:
        body: Sizes of the network.
        query_channels: Channels of the query beside the map.
    """

    def __init__(self, body: UNetBody, query_channels: int) -> None:
        super().__init__()
        widths = body.widths
        self.stem = _double_convolution(1 + query_channels, widths[0])
        self.down = nn.ModuleList(
            nn.Sequential(nn.MaxPool2d(2), _double_convolution(fine, coarse))
            for fine, coarse in itertools.pairwise(widths)
        )
        # On the way up, a level gives the width of the next finer one, the finest its own.
        given = (widths[0], *widths[:-2])
        taken = (*given[1:], widths[-1])
        self.up = nn.ModuleList(
            _double_convolution(skipped + below, out)
            for skipped, below, out in zip(widths[:-1], taken, given, strict=True)
        )
        self.classifier = nn.Conv2d(widths[0], 2, 1)

    def forward(self, occupancy: Tensor, query: Tensor) -> Proposal:
        """Propose a region.

        Args:
            occupancy: (B, 1, H, W) float, 1 = blocked; any H and W.
            query: (B, C, H, W) float.

        Returns:
            The proposal, with an anchor for each pixel.
        """
        height, width = occupancy.shape[-2:]
        coarsest = 2 ** len(self.down)
        margin = (0, -width % coarsest, 0, -height % coarsest)
        levels = [
            self.stem(torch.cat([F.pad(occupancy, margin, value=1.0), F.pad(query, margin)], dim=1))
        ]
        for layer in self.down:
            levels.append(layer(levels[-1]))
        features = levels.pop()
        for layer in reversed(list(self.up)):
            upsampled = F.interpolate(features, scale_factor=2.0, mode="bilinear")
            features = layer(torch.cat([levels.pop(), upsampled], dim=1))
        classes = self.classifier(features)[..., :height, :width]
        # The difference of two classes' logits is the log-odds of the softmax.
        return Proposal(classes[:, 1:] - classes[:, :1])


def _double_convolution(inputs: int, outputs: int) -> nn.Sequential:
    return nn.Sequential(
        nn.Conv2d(inputs, outputs, 3, padding=1, bias=False),
        nn.BatchNorm2d(outputs),
        nn.ReLU(),
        nn.Conv2d(outputs, outputs, 3, padding=1, bias=False),
        nn.BatchNorm2d(outputs),
        nn.ReLU(),
    )
