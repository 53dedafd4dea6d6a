"""The newest map, shared by the threads that receive it and those that plan on it."""

from __future__ import annotations

import threading
import time
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from planformer.errors import InvalidMap
from planformer.maps import Costmap
from planformer.maps.costmap import inflated, with_patch, with_unknown_free


@dataclass(frozen=True, eq=False)
class Snapshot:
    """A map at one moment; another object means another map.

    Attributes:
        costmap: The costs.
        is_inflated: Whether they are a costmap's, or a plain map's that no one has inflated.
        received: When it came [s], by `time.monotonic`.
    """

    costmap: Costmap
    is_inflated: bool
    received: float = field(default_factory=time.monotonic)
    _prepared: dict[tuple[float, bool], Costmap] = field(default_factory=dict, init=False)

    def for_robot(self, radius: float, *, unknown_is_free: bool) -> Costmap:
        """The costmap for a robot without extent.

        It is made once: inflating a large map takes longer than planning on it.

        Args:
            radius: What the costmap's inflation lacks, in metres.
            unknown_is_free: Whether unknown cells may be driven through.
        """
        key = radius, unknown_is_free
        if key not in self._prepared:
            costmap = with_unknown_free(self.costmap) if unknown_is_free else self.costmap
            self._prepared[key] = inflated(costmap, radius) if radius > 0.0 else costmap
        return self._prepared[key]


class World:
    """Holds the newest costmap, or the newest plain map as long as there is no costmap."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._map: Snapshot | None = None
        self._costmap: Snapshot | None = None

    def newest(self) -> Snapshot | None:
        """What to plan on, None before the first map."""
        with self._lock:
            return self._costmap or self._map

    def set_map(self, costmap: Costmap) -> None:
        """Take a plain map."""
        with self._lock:
            self._map = Snapshot(costmap, is_inflated=False)

    def set_costmap(self, costmap: Costmap) -> None:
        """Take a costmap."""
        with self._lock:
            self._costmap = Snapshot(costmap, is_inflated=True)

    def update_costmap(self, costs: NDArray[np.uint8], column: int, row: int) -> None:
        """Replace a rectangle of the costmap.

        Raises:
            InvalidMap: There is no costmap yet, or the rectangle does not lie on it.
        """
        with self._lock:
            if self._costmap is None:
                raise InvalidMap("an update came before the costmap that it changes")
            changed = with_patch(self._costmap.costmap, costs, column, row)
            self._costmap = Snapshot(changed, is_inflated=True)
