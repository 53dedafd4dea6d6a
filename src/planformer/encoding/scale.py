"""The scale at which a network sees the world: pixels, tokens, patches."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields
from enum import Enum
from typing import Any

from planformer.errors import InvalidParameter


class QueryKind(str, Enum):
    """How start and goal are shown to a network.

    SQUARE is the paper's encoding: one channel at the map's resolution with a patch of -1 at the
    start and of +1 at the goal. MARKERS are soft markers on a coarse grid. WAVEFRONT adds the
    geodesic distances from start and goal on that grid, so that the network need not learn to
    search.
    """

    SQUARE = "square"
    MARKERS = "markers"
    WAVEFRONT = "wavefront"


@dataclass(frozen=True)
class NetworkScale:
    """Geometry shared by a network, its labels and its regions; stored in the weights' card.

    Attributes:
        resolution: Side of a network pixel in metres.
        stride: Network pixels between neighbouring tokens.
        patch: Side in network pixels of the square that a token stands for.
        anchor_offset: Position in network pixels of token 0's anchor point, the centre of its
            patch, along either axis.
        query: How start and goal are encoded.
        query_stride: Network pixels a query pixel; 1 = the query has the map's resolution.
        headings: Whether start, goal and the prediction have a heading (SE(2)).
        offsets: Whether the prediction has the way from each anchor to the path.

    Raises:
        InvalidParameter: A value is out of range.
    """

    resolution: float = 0.05
    stride: int = 20
    patch: int = 32
    anchor_offset: int = 10
    query: QueryKind = QueryKind.WAVEFRONT
    query_stride: int = 5
    headings: bool = False
    offsets: bool = False

    def __post_init__(self) -> None:
        try:
            object.__setattr__(self, "query", QueryKind(self.query))
        except ValueError:
            valid = ", ".join(kind.value for kind in QueryKind)
            raise InvalidParameter(f"query must be one of {valid}; got {self.query!r}") from None
        if not (math.isfinite(self.resolution) and self.resolution > 0):
            raise InvalidParameter(f"resolution must be finite and > 0 m; got {self.resolution}")
        for name in ("stride", "patch", "query_stride"):
            if getattr(self, name) < 1:
                raise InvalidParameter(f"{name} must be >= 1 px; got {getattr(self, name)}")
        if not 0 <= self.anchor_offset < self.stride:
            raise InvalidParameter(
                f"anchor_offset must be in [0, stride); got {self.anchor_offset} of {self.stride}"
            )
        if self.stride % self.query_stride:
            raise InvalidParameter(
                f"query_stride must divide the stride {self.stride}; got {self.query_stride}"
            )
        if self.query is QueryKind.SQUARE and self.query_stride != 1:
            raise InvalidParameter(
                f"the square query needs query_stride 1; got {self.query_stride}"
            )

    @property
    def query_channels(self) -> int:
        """Number of channels of the query."""
        plain = {QueryKind.SQUARE: 1, QueryKind.MARKERS: 3, QueryKind.WAVEFRONT: 6}[self.query]
        heading = 2 if self.query is QueryKind.SQUARE else 4
        return plain + heading * self.headings

    @property
    def query_resolution(self) -> float:
        """Side of a query pixel in metres."""
        return self.resolution * self.query_stride

    def padded(self, pixels: int) -> int:
        """The next multiple of the stride."""
        return -(-pixels // self.stride) * self.stride

    def to_dict(self) -> dict[str, Any]:
        """The scale as JSON-compatible values."""
        return {**asdict(self), "query": self.query.value}

    @classmethod
    def from_dict(cls, values: Mapping[str, Any]) -> NetworkScale:
        """The inverse of `to_dict`.

        Raises:
            InvalidParameter: A key is unknown or a value out of range.
        """
        known = {field.name for field in fields(cls)}
        if unknown := sorted(set(values) - known):
            raise InvalidParameter(
                f"unknown network scale keys {unknown}; valid are {sorted(known)}"
            )
        return cls(**values)
