"""Guidance: networks propose a region of the map, planners search there."""

from planformer.guidance.onnx import OnnxNetwork, OnnxProposer, load_network
from planformer.guidance.proposer import RegionProposer, resolve_guide
from planformer.guidance.region import Region, make_region
from planformer.guidance.weights import guide_names

__all__ = [
    "OnnxNetwork",
    "OnnxProposer",
    "Region",
    "RegionProposer",
    "guide_names",
    "load_network",
    "make_region",
    "resolve_guide",
]
