"""Where a planner draws its samples: the shapes round a region's anchor points."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from planformer.errors import InvalidParameter

ELLIPSE_ASPECT = 0.5
"""Minor over major axis of the ellipses that a car's positions are drawn from. Squares that have an
offset from their anchors are narrower by as much: they lie round a path, not round a lattice."""
YAW_DEVIATION = 0.35
"""Standard deviation [rad] of a car's yaw round a heading of unknown certainty."""
REFINEMENT = 0.2
"""Share of the samples near the best path so far; the others still find other ways."""
REFINEMENT_IN_REGION = 0.5
"""The same in a region, which leaves few ways to be found."""


@dataclass(frozen=True, eq=False)
class SamplingRegion:
    """Shapes of one size round anchor points, in the world frame.

    Without headings the shapes are squares and a car's yaw is uniform; with headings they are
    ellipses along them (Motion Planning Transformers, section III.B). Shapes with an offset from
    their anchors are cut off where the anchors' squares end; squares then have half the side, but a
    fifth of the samples still fill the anchors' own. With headings some samples are poses soon
    after the start or shortly before the goal, because a car often has to turn about there.

    Attributes:
        anchors: (K, 2) float64 anchor points in metres, K >= 1.
        headings: (K,) float64 predicted headings in rad, or None.
        half_width: Half the side of the anchors' squares in metres, also an ellipse's major
            semi-axis.
        area: Area of the union of the shapes in square metres.
        yaw_deviations: (K,) float64 standard deviation of the yaw round each heading in rad, > 0;
            None for 0.35 rad everywhere.
        offsets: (K, 2) float64 way in metres from each anchor to the centre of its shape, inside
            its square; None for shapes round the anchors themselves.

    Raises:
        InvalidParameter: Empty, mismatched or not finite arrays, or a size that is not positive.
    """

    anchors: NDArray[np.float64]
    headings: NDArray[np.float64] | None
    half_width: float
    area: float
    yaw_deviations: NDArray[np.float64] | None = None
    offsets: NDArray[np.float64] | None = None

    @property
    def minor_axis(self) -> float:
        """Minor semi-axis of an ellipse, or half the side of a square to draw from, in metres."""
        is_lattice = self.headings is None and self.offsets is None
        return self.half_width if is_lattice else ELLIPSE_ASPECT * self.half_width

    def __post_init__(self) -> None:
        if self.anchors.ndim != 2 or self.anchors.shape[1] != 2 or len(self.anchors) == 0:
            raise InvalidParameter(
                f"anchors must have shape (K, 2), K >= 1; got {self.anchors.shape}"
            )
        if self.headings is not None and self.headings.shape != (len(self.anchors),):
            raise InvalidParameter(
                f"headings must have shape ({len(self.anchors)},); got {self.headings.shape}"
            )
        deviations = self.yaw_deviations
        if deviations is not None and (
            self.headings is None
            or deviations.shape != self.headings.shape
            or not (np.isfinite(deviations) & (deviations > 0.0)).all()
        ):
            raise InvalidParameter(
                f"yaw_deviations must be {len(self.anchors)} finite values > 0 and go with headings"
            )
        sizes = (self.half_width, self.area)
        if not (np.isfinite(sizes).all() and min(sizes) > 0.0):
            raise InvalidParameter(
                f"half_width and area must be finite and > 0; got {self.half_width} and {self.area}"
            )
        if self.offsets is not None and self.offsets.shape != self.anchors.shape:
            raise InvalidParameter(
                f"offsets must have shape {self.anchors.shape}; got {self.offsets.shape}"
            )
        values = [v for v in (self.anchors, self.headings, self.offsets) if v is not None]
        if not all(np.isfinite(value).all() for value in values):
            raise InvalidParameter("anchors, headings and offsets must be finite")
