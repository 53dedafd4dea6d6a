"""Guidance: networks propose a region of the map, planners search there."""

from planformer.guidance.onnx import OnnxNetwork, OnnxProposer, load_network
from planformer.guidance.proposer import AUTO, Guide, RegionProposer, resolve_guide
from planformer.guidance.region import Region, make_region
from planformer.guidance.weights import default_guide, guide_names

__all__ = [
    "AUTO",
    "Guide",
    "OnnxNetwork",
    "OnnxProposer",
    "Region",
    "RegionProposer",
    "default_guide",
    "guide_names",
    "load_network",
    "make_region",
    "resolve_guide",
]
