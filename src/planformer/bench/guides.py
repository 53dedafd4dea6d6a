"""What is measured: networks by name, and two guides that no network is needed for."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from planformer.bench.rows import Row
from planformer.encoding import (
    NetworkScale,
    anchor_headings,
    anchor_labels,
    anchor_offsets,
    anchor_points,
    encode_query,
    network_map,
)
from planformer.guidance import OnnxProposer, Region, RegionProposer, load_network, make_region
from planformer.guidance.region import PAPER_THRESHOLD
from planformer.planning import Problem

IDEAL = "ideal"
"""The region of a network that makes no mistake."""
WAVEFRONT = "wavefront"
"""A corridor along the shortest ways of a grid search: what needs no learning."""

THRESHOLDS: dict[str, float | None] = {"fixed": PAPER_THRESHOLD, "connecting": None}
"""Rules for the threshold: the paper's value, or the one that connects start and goal."""

_DETOUR_CHANNEL = 4
"""Of a wavefront query: 1 on a shortest way, less the longer the detour."""


@dataclass(frozen=True)
class IdealProposer:
    """Selects the anchors within 0.7 m of a path; for a car with its headings and the way to it.

    Attributes:
        path: (N, 2) or (N, 3) path in the world frame.
        scale: Scale of the network that it stands for.
    """

    path: NDArray[np.float64]
    scale: NetworkScale = field(default_factory=NetworkScale)

    def propose(self, problem: Problem) -> Region:
        """The region of the path."""
        height, width = problem.grid.shape
        ratio = problem.grid.resolution / self.scale.resolution
        rows, columns = (self.scale.padded(_pixels(side * ratio)) for side in (height, width))
        anchors = anchor_points(rows, columns, self.scale)
        path = problem.grid.frame.to_local(self.path)
        headings = offsets = None
        if problem.robot.state_dimension == 3:
            cos, sin = anchor_headings(anchors, path).astype(np.float64)
            headings = np.arctan2(sin, cos)
            offsets = anchor_offsets(anchors, path)
        labels = anchor_labels(anchors, path).astype(np.float32)
        return make_region(
            problem,
            labels,
            self.scale,
            headings=headings,
            offsets=offsets,
            threshold=PAPER_THRESHOLD,
        )


def _pixels(size: float) -> int:
    """Network pixels that cover a length in pixels; 480.0000001 is meant to be 480."""
    return max(1, int(np.ceil(size - 1e-6)))


@dataclass(frozen=True)
class WavefrontProposer:
    """Selects the anchors near the shortest ways of the grid search that feeds the networks.

    The probability of an anchor is the largest exp(-detour / 0.75 m) of the 0.25 m cells round
    it, so the threshold 0.5 allows detours of half a metre.

    Attributes:
        threshold: As in `OnnxProposer`.
    """

    threshold: float | None = None

    def propose(self, problem: Problem) -> Region:
        """The corridor."""
        scale = NetworkScale()
        pixels = network_map(problem.blocked, problem.grid.resolution, scale)
        query = encode_query(pixels, problem.local_start, problem.local_goal, scale)
        detour, side = query[_DETOUR_CHANNEL], scale.stride // scale.query_stride
        height, width = detour.shape
        tokens = detour.reshape(height // side, side, width // side, side).max(axis=(1, 3))
        return make_region(problem, tokens, scale, threshold=self.threshold)


@dataclass(frozen=True)
class Variant:
    """A guide with a rule for its threshold.

    Attributes:
        guide: `IDEAL`, `WAVEFRONT`, the name of shipped weights or the path of an .onnx file.
        threshold: A name in `THRESHOLDS`.
    """

    guide: str
    threshold: str

    @property
    def scale(self) -> NetworkScale:
        """Scale at which the guide sees the map."""
        learned = self.guide not in (IDEAL, WAVEFRONT)
        return load_network(self.guide).weights.scale if learned else NetworkScale()

    def proposer(self, reference: NDArray[np.float64]) -> RegionProposer:
        """The proposer; only the ideal one makes use of the reference path."""
        threshold = THRESHOLDS[self.threshold]
        if self.guide == IDEAL:
            return IdealProposer(reference)
        if self.guide == WAVEFRONT:
            return WavefrontProposer(threshold)
        return OnnxProposer(load_network(self.guide), threshold)


def variants(guides: tuple[str, ...], row: Row) -> tuple[Variant, ...]:
    """All that is measured on a row: guides that need headings have none in the plane."""
    rules = {guide: ("fixed",) if guide == IDEAL else tuple(THRESHOLDS) for guide in guides}
    every = [Variant(guide, rule) for guide in guides for rule in rules[guide]]
    return tuple(v for v in every if not (row.plane and v.scale.headings))


def fingerprints(guides: tuple[str, ...]) -> dict[str, str]:
    """What each guide is, as far as a file can tell: the SHA-256 of a network.

    Raises:
        UnknownGuide: No such weights.
        InvalidWeights: A file is damaged or does not fit its card.
    """
    return {
        guide: guide
        if guide in (IDEAL, WAVEFRONT)
        else hashlib.sha256(load_network(guide).weights.model).hexdigest()
        for guide in guides
    }
