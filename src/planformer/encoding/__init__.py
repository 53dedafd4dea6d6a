"""What goes into the networks and where their outputs lie. NumPy only."""

from planformer.encoding.anchors import (
    LABEL_DISTANCE,
    anchor_headings,
    anchor_labels,
    anchor_offsets,
    anchor_points,
    region_mask,
)
from planformer.encoding.query import encode_query, encode_windows
from planformer.encoding.raster import network_map, network_shape
from planformer.encoding.scale import NetworkScale, QueryKind
from planformer.encoding.window import Window, stitch

__all__ = [
    "LABEL_DISTANCE",
    "NetworkScale",
    "QueryKind",
    "Window",
    "anchor_headings",
    "anchor_labels",
    "anchor_offsets",
    "anchor_points",
    "encode_query",
    "encode_windows",
    "network_map",
    "network_shape",
    "region_mask",
    "stitch",
]
