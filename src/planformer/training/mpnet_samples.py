"""From stored paths to the waypoints that MPNet learns to predict."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor

from planformer.encoding import NetworkScale, network_map
from planformer.errors import InvalidDataset
from planformer.training.augmentation import Example, turned
from planformer.training.sources import PathSource


class WaypointBatch(NamedTuple):
    """Waypoints to predict on some maps; coordinates go from -1 to 1 over the map.

    Attributes:
        maps: A (1, 1, H, W) uint8 map each, 1 = blocked.
        current: (M * K, 2) float32 states, K on each map.
        goal: (M * K, 2) float32 states to reach.
        target: (M * K, 2) float32, the waypoint that the path visits first on the way.
    """

    maps: list[Tensor]
    current: Tensor
    goal: Tensor
    target: Tensor

    def to(self, device: torch.device) -> WaypointBatch:
        """The batch on a device."""
        states = (self.current.to(device), self.goal.to(device), self.target.to(device))
        return WaypointBatch([pixels.to(device) for pixels in self.maps], *states)


class WaypointSamples:
    """Draws waypoints from a data set's paths; only those with a corner teach anything.

    Args:
        source: The paths.
        scale: The geometry of the network's maps.

    Raises:
        InvalidDataset: The paths are a car's, or none has a corner.
    """

    def __init__(self, source: PathSource, scale: NetworkScale) -> None:
        self._source, self._scale = source, scale
        self._problems: dict[int, list[int]] = {}
        for index in range(len(source)):
            problem = source[index]
            if problem.path.shape[1] != 2:
                raise InvalidDataset("MPNet plans for a point robot; the data set is of a car")
            if len(problem.path) > 2:
                self._problems.setdefault(problem.map_id, []).append(index)
        if not self._problems:
            raise InvalidDataset("all paths of the data set are straight lines")
        self.map_ids = list(self._problems)
        """Maps that have a path with a corner."""

    def draw(
        self, map_ids: Sequence[int], waypoints: int, rng: np.random.Generator, *, augment: bool
    ) -> WaypointBatch:
        """Draw waypoints on some maps.

        Args:
            map_ids: The maps, among `map_ids` of the samples.
            waypoints: Waypoints on each.
            rng: Source of randomness.
            augment: Flip and turn the maps at random.
        """
        examples = [self._example(map_id, waypoints, rng) for map_id in map_ids]
        if augment:
            examples = [turned(e, *rng.integers(2, size=3, dtype=bool)) for e in examples]
        maps = [network_map(e.blocked, e.resolution, self._scale)[None, None] for e in examples]
        states = ([_normalised(e, name) for e in examples] for name in ("start", "goal", "path"))
        return WaypointBatch(
            [torch.from_numpy(pixels) for pixels in maps],
            *(torch.from_numpy(np.concatenate(parts).astype(np.float32)) for parts in states),
        )

    def _example(self, map_id: int, waypoints: int, rng: np.random.Generator) -> Example:
        """(K, 2) states, goals and next waypoints on one map in the fields of an example."""
        paths = [self._source[index].path for index in self._problems[map_id]]
        paths += [path[::-1] for path in paths]
        chosen = rng.integers(len(paths), size=waypoints)
        rows = np.stack([_next_waypoint(paths[i], *rng.random(2)) for i in chosen])
        blocked = self._source.blocked_map(map_id)
        resolution = self._source.recipes[map_id].resolution
        return Example(blocked, resolution, rows[:, 0], rows[:, 1], rows[:, 2])


def _next_waypoint(path: NDArray[np.float64], start: float, end: float) -> NDArray[np.float64]:
    """A point of a path, a later one behind a corner at least, and the first corner between.

    The planner asks from either end and from states in the middle, so both points may lie anywhere
    on the path, uniformly in its length.

    Args:
        path: (N, 2) vertices, N >= 3.
        start: Where the point lies, in [0, 1) of the path up to its last corner.
        end: Where the later one lies, in [0, 1) from the corner to the path's end.

    Returns:
        (3, 2): the point, the later one, the corner.
    """
    along = np.concatenate(([0.0], np.hypot(*np.diff(path, axis=0).T).cumsum()))
    first = start * along[-2]
    corner = min(int(np.searchsorted(along, first, side="right")), len(path) - 2)
    last = along[corner] + end * (along[-1] - along[corner])
    x, y = (np.interp((first, last), along, coordinate) for coordinate in path.T)
    return np.vstack([np.column_stack((x, y)), path[corner]])


def _normalised(example: Example, name: str) -> NDArray[np.float64]:
    extent = np.array(example.blocked.shape[::-1]) * example.resolution
    states: NDArray[np.float64] = getattr(example, name)
    return 2.0 * states / extent - 1.0
