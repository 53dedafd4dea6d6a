"""The service's maps: the last used in memory, uploads in a folder if there is one."""

from __future__ import annotations

import threading
from collections import OrderedDict

from planformer.errors import TooLarge, UnknownMap
from planformer.serve.map_folder import MapFolder
from planformer.serve.responses import MapInfo
from planformer.serve.served_map import ServedMap
from planformer.serve.settings import ServeSettings

_LONGEST_SIDE = 65_535
"""Of the pictures that browsers draw."""


class MapStore:
    """Maps by their id; safe to use from several threads.

    Args:
        settings: Bounds, and the folder.
    """

    def __init__(self, settings: ServeSettings) -> None:
        self._settings = settings
        self._lock = threading.Lock()  # of what is in memory; never held for long
        self._folder_lock = threading.Lock()
        self._recent: OrderedDict[str, ServedMap] = OrderedDict()
        self._folder = None if settings.folder is None else MapFolder(settings.folder, settings)

    def add(self, served: ServedMap, *, keep: bool = False) -> MapInfo:
        """Take a map in; the same content again is the same map.

        Args:
            served: The map.
            keep: Write it to the folder, if there is one.

        Raises:
            TooLarge: It has too many cells, or too many in a row.
            StoreFull: The folder is full.
        """
        if served.grid.occupied.size > self._settings.map_cells:
            raise TooLarge(
                f"{served.info.columns} x {served.info.rows} cells are more than the "
                f"{self._settings.map_cells:,} that a map may have here"
            )
        if max(served.grid.shape) > _LONGEST_SIDE:
            raise TooLarge(f"a map has at most {_LONGEST_SIDE:,} cells along a side here")
        if keep and self._folder is not None:
            with self._folder_lock:
                self._folder.save(served)
        known = None if keep else self.recent(served.info.id)
        return self._remember(served).info if known is None else known.info

    def recent(self, map_id: str) -> ServedMap | None:
        """The map of an id if it is in memory; does not wait for files."""
        with self._lock:
            if map_id not in self._recent:
                return None
            self._recent.move_to_end(map_id)
            return self._recent[map_id]

    def get(self, map_id: str) -> ServedMap:
        """The map of an id.

        Raises:
            UnknownMap: There is none, or no more.
        """
        served = self.recent(map_id)
        if served is not None:
            return served
        if self._folder is not None:
            with self._folder_lock:
                served = self._folder.load(map_id)
        if served is None:
            raise UnknownMap(f"no map has the id {map_id}; GET /maps lists those that are here")
        return self._remember(served)

    def list(self) -> list[MapInfo]:
        """All maps: those of the folder, then those in memory, the last used at the end."""
        infos = {} if self._folder is None else self._folder.infos.copy()
        with self._lock:
            infos |= {map_id: served.info for map_id, served in self._recent.items()}
            return list(infos.values())

    def delete(self, map_id: str) -> None:
        """Forget a map, and remove its files if the service wrote them.

        Raises:
            UnknownMap: There is none.
            RequestRefused: The map's file is not the service's, or cannot be removed.
        """
        in_folder = False
        if self._folder is not None:
            with self._folder_lock:
                in_folder = self._folder.has(map_id)
                if in_folder:
                    self._folder.remove(map_id)
        with self._lock:
            in_memory = self._recent.pop(map_id, None) is not None
        if not (in_folder or in_memory):
            raise UnknownMap(f"no map has the id {map_id}")

    @property
    def cells(self) -> int:
        """Cells of the maps in memory."""
        with self._lock:
            return self._cells()

    def _cells(self) -> int:
        return sum(served.grid.occupied.size for served in self._recent.values())

    def _remember(self, served: ServedMap) -> ServedMap:
        """Make a map the last used one; the oldest give way."""
        info = served.info  # made before the lock is taken: it looks at every cell
        with self._lock:
            self._recent[info.id] = served
            self._recent.move_to_end(info.id)
            while (
                len(self._recent) > self._settings.maps
                or self._cells() > self._settings.cells_in_memory
            ):
                self._recent.popitem(last=False)
        return served
