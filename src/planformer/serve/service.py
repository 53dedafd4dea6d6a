"""What the routes share: limits, maps, threads, counters."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

from planformer.errors import Busy, ShuttingDown
from planformer.maps import OccupancyGrid
from planformer.serve.metrics import Metrics
from planformer.serve.pool import PlanPool
from planformer.serve.settings import ServeSettings
from planformer.serve.store import MapStore

T = TypeVar("T")

_ENDING = "the service is shutting down"

_MAP_THREADS = 2
"""Maps that are decoded, made or drawn at once; each may need hundreds of megabytes."""

_MAP_JOBS = 32
"""Such jobs that run or wait for their turn: a flood of them leaves connections to others."""


class Service:
    """The state of one application.

    Args:
        settings: Its limits.
    """

    def __init__(self, settings: ServeSettings) -> None:
        self.settings = settings
        self.store = MapStore(settings)
        self.pool = PlanPool(settings.plans, settings.patience_seconds)
        self.metrics = Metrics(self.pool, self.store)
        self._map_threads = ThreadPoolExecutor(_MAP_THREADS, thread_name_prefix="map")
        self._map_jobs, self._closed = 0, False

    async def in_thread(self, work: Callable[[], T]) -> T:
        """Do work on a map while other requests go on.

        Raises:
            Busy: Too much such work is waiting.
            ShuttingDown: The service is closed.
        """
        if self._closed:
            raise ShuttingDown(_ENDING)
        if self._map_jobs >= _MAP_JOBS:
            raise Busy(f"{_MAP_JOBS} requests wait for maps; ask again in a second")
        self._map_jobs += 1
        try:
            return await asyncio.get_running_loop().run_in_executor(self._map_threads, work)
        except asyncio.CancelledError:
            if self._closed:
                raise ShuttingDown(_ENDING) from None
            raise
        finally:
            self._map_jobs -= 1

    async def grid(self, map_id: str) -> OccupancyGrid:
        """A map's cells; it may have to be read from the folder.

        Raises:
            UnknownMap: There is none.
        """
        served = self.store.recent(map_id)
        if served is None:
            served = await self.in_thread(lambda: self.store.get(map_id))
        return served.grid

    def close(self) -> None:
        """Cancel running searches and refuse new work."""
        self._closed = True
        self._map_threads.shutdown(wait=False, cancel_futures=True)
        self.pool.close()
