"""The proposed region: anchor probabilities, and the part of the map that they select."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from planformer import _core
from planformer.encoding import NetworkScale, anchor_points, network_shape
from planformer.errors import InvalidParameter
from planformer.geometry import Frame
from planformer.maps import OccupancyGrid
from planformer.planning import Problem, SamplingRegion, is_connected

PAPER_THRESHOLD = 0.5
"""The fixed threshold of Motion Planning Transformers (figure 3)."""

RELAXATION = 0.5
"""Anchors this much less likely than the weakest one needed to connect start and goal are kept, so
that the shortest path and not just any path fits (benchmarks/regions.py)."""


@dataclass(frozen=True, eq=False)
class Region:
    """The part of a map in which a good path is believed to run.

    Attributes:
        problem: What it was proposed for: map, robot, start and goal.
        probability: (h, w) float32, one value an anchor point; row 0 = lowest y of the map.
        anchors: (h, w, 2) float64 anchor points in metres in the world frame.
        threshold: Anchors at least this probable are selected.
        mask: (H, W) bool, the map's cells inside the patches of the selected anchors.
        connected: Whether start and goal are connected within the region and free space.
        patch: Side of an anchor's patch in metres.
        headings: (h, w) float64 headings in rad in the world frame, None if not predicted.
        yaw_deviations: (h, w) float64 standard deviation of the yaw round each heading in rad; None
            without headings, or for the same everywhere.
        offsets: (h, w, 2) float64 predicted way in metres, in the world frame, from each anchor to
            the path, None if not predicted. Samples are drawn round the anchors so moved, but
            inside the selected patches.
    """

    problem: Problem
    probability: NDArray[np.float32]
    anchors: NDArray[np.float64]
    threshold: float
    mask: NDArray[np.bool_]
    connected: bool
    patch: float
    headings: NDArray[np.float64] | None
    yaw_deviations: NDArray[np.float64] | None = None
    offsets: NDArray[np.float64] | None = None

    @property
    def selected(self) -> NDArray[np.bool_]:
        """(h, w) bool, the anchors at or above the threshold."""
        return np.asarray(self.probability >= self.threshold)

    @property
    def share(self) -> float:
        """Share of the map's area inside the region, 0 to 1."""
        return float(self.mask.mean())

    def sampling(self) -> SamplingRegion | None:
        """Where a planner draws samples; None if no anchor is selected."""
        chosen = self.selected
        if not chosen.any():
            return None
        return SamplingRegion(
            anchors=self.anchors[chosen],
            headings=None if self.headings is None else self.headings[chosen],
            yaw_deviations=None if self.yaw_deviations is None else self.yaw_deviations[chosen],
            offsets=None if self.offsets is None else self.offsets[chosen],
            half_width=0.5 * self.patch,
            # At least a cell: the patches of a padded map may lie beside it.
            area=max(int(self.mask.sum()), 1) * self.problem.grid.resolution**2,
        )

    def _repr_html_(self) -> str:
        from planformer.notebook import region_html

        return region_html(self)

    def __repr__(self) -> str:
        height, width = self.probability.shape
        return (
            f"Region({width} x {height} anchors, {int(self.selected.sum())} selected at "
            f"threshold {self.threshold:.3g}, {self.share:.1%} of the map, "
            f"{'connected' if self.connected else 'not connected'})"
        )


def make_region(
    problem: Problem,
    probability: NDArray[np.float32],
    scale: NetworkScale,
    *,
    headings: NDArray[np.float64] | None = None,
    yaw_deviations: NDArray[np.float64] | None = None,
    offsets: NDArray[np.float64] | None = None,
    threshold: float | None = None,
) -> Region:
    """Select anchors and lay their patches over the map.

    Args:
        problem: The problem that the probabilities were predicted for.
        probability: (h, w) probability of each anchor, one for each stride of the `network_map`.
        scale: Scale of the network that predicted them.
        headings: (h, w) headings in rad in the map's own frame, None in the plane.
        yaw_deviations: (h, w) standard deviation of the yaw round them in rad, None for 0.35.
        offsets: (h, w, 2) way in metres, in the map's own frame, from each anchor to the path; None
            to draw samples round the anchors themselves.
        threshold: Fixed threshold in [0, 1]; 0.5 is the paper's. None chooses it for this query:
            the highest one at which start and goal are connected, relaxed.

    Raises:
        InvalidParameter: The probabilities, headings or offsets have other shapes, or a probability
            is outside [0, 1].
    """
    probability = _checked_probability(probability)
    pixels = network_shape(problem.grid.shape, problem.grid.resolution, scale)
    _check_shape("probability", probability, tuple(size // scale.stride for size in pixels))
    _check_shape("headings", headings, probability.shape)
    _check_shape("yaw_deviations", yaw_deviations, probability.shape)
    _check_shape("offsets", offsets, (*probability.shape, 2))
    height, width = probability.shape
    local = anchor_points(height * scale.stride, width * scale.stride, scale)
    cells = spread(probability, problem.grid, scale)
    if threshold is None:
        widest = connecting_threshold(cells, problem)
        connected = widest is not None
        threshold = RELAXATION * (PAPER_THRESHOLD if widest is None else widest)
        mask = cells >= threshold
    else:
        mask = cells >= threshold
        connected = is_connected(mask & ~problem.blocked, problem)
    frame = problem.grid.frame
    return Region(
        problem=problem,
        probability=probability,
        anchors=frame.to_world(local),
        threshold=threshold,
        mask=mask,
        connected=connected,
        patch=scale.patch * scale.resolution,
        headings=None if headings is None else headings + frame.yaw,
        yaw_deviations=yaw_deviations,
        offsets=None if offsets is None else _within_patch(offsets, scale, frame),
    )


def _within_patch(
    offsets: NDArray[np.float64], scale: NetworkScale, frame: Frame
) -> NDArray[np.float64]:
    """(h, w, 2) offsets that stay in the anchors' patches, turned to the world frame."""
    reach = 0.5 * scale.patch * scale.resolution
    return Frame(yaw=frame.yaw).to_world(np.clip(offsets, -reach, reach))


def _check_shape(name: str, values: NDArray[Any] | None, shape: tuple[int, ...]) -> None:
    if values is not None and values.shape != shape:
        raise InvalidParameter(f"{name} must have the shape {shape}; got {values.shape}")


def _checked_probability(probability: NDArray[np.float32]) -> NDArray[np.float32]:
    # One type for all that is compared with the threshold.
    values = np.asarray(probability, dtype=np.float32)
    if values.ndim != 2 or values.size == 0:
        raise InvalidParameter(f"probability must have shape (h, w); got {values.shape}")
    if not ((values >= 0.0) & (values <= 1.0)).all():
        raise InvalidParameter("probabilities must be between 0 and 1")
    return values


def spread(
    probability: NDArray[np.float32], grid: OccupancyGrid, scale: NetworkScale
) -> NDArray[np.float32]:
    """The largest probability of the anchors whose patch covers each cell of the map.

    Thresholding it gives the union of the selected anchors' patches at once for any threshold.

    Args:
        probability: (h, w) probability of each anchor.
        grid: The map.
        scale: The network's scale.

    Returns:
        (H, W) float32; cells in no patch are -1.
    """
    # Between the edges of patches the cells of a row are all the same, and so are whole rows.
    rows, row_counts = _spread_axis(probability.T, grid.shape[0], grid, scale)
    values, column_counts = _spread_axis(rows.T, grid.shape[1], grid, scale)
    return values.repeat(column_counts, axis=1).repeat(row_counts, axis=0)


def _spread_axis(
    values: NDArray[np.float32], cells: int, grid: OccupancyGrid, scale: NetworkScale
) -> tuple[NDArray[np.float32], NDArray[np.intp]]:
    """`spread` along the last axis alone.

    Returns:
        A value for each run of cells that are in the same patches, and the lengths of the runs.
    """
    pixels = (np.arange(cells) + 0.5) * grid.resolution / scale.resolution
    # Patches are half-open, as in `region_mask`: from `patch // 2` before the anchor.
    offset = pixels - scale.anchor_offset + scale.patch // 2
    first = np.floor((offset - scale.patch) / scale.stride).astype(np.intp) + 1
    last = np.floor(offset / scale.stride).astype(np.intp)
    begins = np.flatnonzero(np.diff(first) | np.diff(last)) + 1
    begins = np.concatenate(([0], begins))
    first, last = first[begins], last[begins]
    padded = np.pad(values, ((0, 0), (0, 1)), constant_values=-1.0)  # in the end: no token
    covering = first[:, None] + np.arange(max((last - first).max(), 0) + 1)
    exists = (covering <= last[:, None]) & (covering >= 0) & (covering < values.shape[1])
    largest = padded[:, np.where(exists, covering, values.shape[1])].max(axis=-1)
    return largest, np.diff(begins, append=cells)


def connecting_threshold(cells: NDArray[np.float32], problem: Problem) -> float | None:
    """The highest threshold at which start and goal are connected in region and free space.

    Args:
        cells: (H, W) probability of each cell as `spread` gives it.
        problem: The problem.

    Returns:
        The threshold, or None where no region connects them: the map itself does not, or only
        through cells in no patch.
    """
    start, goal = problem.grid.to_rc([problem.start[:2], problem.goal[:2]]).tolist()
    return _core.widest_path(problem.blocked, cells, start, goal)
