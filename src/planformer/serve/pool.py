"""The threads that searches run in: so many at once, and each ends when its client goes away."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Callable
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import asynccontextmanager
from typing import TypeVar

from fastapi import Request

from planformer.errors import Busy, ShuttingDown
from planformer.planning import CancelToken

T = TypeVar("T")


class PlanPool:
    """A bounded number of searches; use it from one event loop.

    Args:
        plans: Searches at once.
        patience: Seconds that a search waits for its turn before it is refused.
    """

    def __init__(self, plans: int, patience: float) -> None:
        self._threads = ThreadPoolExecutor(plans, thread_name_prefix="plan")
        self._turns = asyncio.Semaphore(plans)
        self._plans, self._patience = plans, patience
        self._running: set[CancelToken] = set()
        self._closed = False

    @property
    def running(self) -> int:
        """Searches that run now."""
        return len(self._running)

    async def run(self, request: Request, work: Callable[[CancelToken], T]) -> T:
        """Let a search run and wait for it; it is cancelled when the client goes away.

        Raises:
            Busy: No thread became free in time.
            ShuttingDown: The pool is closed.
        """
        async with self.search(request, work) as result:
            return await result

    @asynccontextmanager
    async def search(
        self, request: Request, work: Callable[[CancelToken], T]
    ) -> AsyncIterator[asyncio.Future[T]]:
        """A search in a thread; leaving the block cancels it, as a client that goes away does.

        Raises:
            Busy: No thread became free in time.
            ShuttingDown: The pool is closed.
        """
        token = CancelToken()
        future = await self._start(work, token)
        watch = asyncio.create_task(_cancel_when_gone(request, token))
        try:
            # Shielded: a thread cannot be abandoned, only told to end.
            yield asyncio.shield(asyncio.wrap_future(future))
        finally:
            token.cancel()
            watch.cancel()

    async def _start(self, work: Callable[[CancelToken], T], token: CancelToken) -> Future[T]:
        await self._take_turn()
        loop = asyncio.get_running_loop()
        self._running.add(token)
        future = self._threads.submit(work, token)
        future.add_done_callback(lambda _: loop.call_soon_threadsafe(self._give_turn, token))
        return future

    async def _take_turn(self) -> None:
        try:
            await asyncio.wait_for(self._turns.acquire(), self._patience)
        except asyncio.TimeoutError:
            raise Busy(
                f"{self._plans} searches are running, which is the most that this service runs at "
                "once; ask again in a second"
            ) from None
        if self._closed:
            self._turns.release()
            raise ShuttingDown("the service is shutting down")

    def _give_turn(self, token: CancelToken) -> None:
        self._running.discard(token)
        self._turns.release()

    def close(self) -> None:
        """Cancel what runs, and refuse what comes."""
        self._closed = True
        for token in list(self._running):
            token.cancel()


async def _cancel_when_gone(request: Request, token: CancelToken) -> None:
    # The body has been read, so that the next message can only say that the client is gone.
    while (await request.receive())["type"] != "http.disconnect":
        pass
    token.cancel()
