"""What is measured: networks by name, and guides that no network is needed for."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from planformer.bench.rows import Row
from planformer.data.experts import shortest_path
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
"""A corridor along the shortest ways of the grid search that feeds the networks."""
LAZY_THETA = "lazy-theta"
"""A corridor along the shortest any-angle path, with its headings for a car."""

UNLEARNED = (IDEAL, WAVEFRONT, LAZY_THETA)

THRESHOLDS: dict[str, float | None] = {"fixed": PAPER_THRESHOLD, "connecting": None}
"""Rules for the threshold: the paper's value, or the one that connects start and goal."""

_DETOUR_CHANNEL = 4
"""Of a wavefront query: 1 on a shortest way, less the longer the detour."""


@dataclass(frozen=True)
class PathProposer:
    """Selects the anchors within 0.7 m of a path; for a car with its headings and the way to it.

    Attributes:
        path: (N, 2) or (N, 3) path in the world frame, N >= 1.
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
class LazyThetaProposer:
    """Selects the anchors along the shortest any-angle path of a disc: none if there is no path."""

    def propose(self, problem: Problem) -> Region:
        """The corridor."""
        ends = problem.start[:2], problem.goal[:2]
        path = shortest_path(problem.grid, problem.robot.radius, *ends)
        return PathProposer(np.asarray(ends[:1]) if path is None else path).propose(problem)


@dataclass(frozen=True)
class Variant:
    """A guide with a rule for its threshold.

    Attributes:
        guide: One of `UNLEARNED`, the name of shipped weights or the path of an .onnx file.
        threshold: A name in `THRESHOLDS`.
    """

    guide: str
    threshold: str

    @property
    def scale(self) -> NetworkScale:
        """Scale at which the guide sees the map."""
        learned = self.guide not in UNLEARNED
        return load_network(self.guide).scale if learned else NetworkScale()

    def proposer(self, reference: NDArray[np.float64]) -> RegionProposer:
        """The proposer; only the ideal one makes use of the reference path."""
        threshold = THRESHOLDS[self.threshold]
        if self.guide == IDEAL:
            return PathProposer(reference)
        if self.guide == WAVEFRONT:
            return WavefrontProposer(threshold)
        if self.guide == LAZY_THETA:
            return LazyThetaProposer()
        return OnnxProposer(load_network(self.guide), threshold)


def variants(guides: tuple[str, ...], row: Row) -> tuple[Variant, ...]:
    """All that is measured on a row: guides that need headings have none in the plane."""
    every = [Variant(guide, rule) for guide in guides for rule in _rules(guide)]
    return tuple(v for v in every if not (row.plane and v.scale.headings))


def _rules(guide: str) -> tuple[str, ...]:
    """The thresholds that make a difference to a guide."""
    return ("fixed",) if guide in (IDEAL, LAZY_THETA) else tuple(THRESHOLDS)


def fingerprints(guides: tuple[str, ...]) -> dict[str, str]:
    """What each guide is, as far as a file can tell: the SHA-256 of a network.

    Raises:
        UnknownGuide: No such weights.
        InvalidWeights: A file is damaged or does not fit its card.
    """
    return {
        guide: guide
        if guide in UNLEARNED
        else hashlib.sha256(load_network(guide).weights.model).hexdigest()
        for guide in guides
    }
