"""A plan as a stream of server-sent events: region, progress, result."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator

from fastapi import Request
from pydantic import BaseModel

from planformer.errors import PlanformerError
from planformer.guidance import Region
from planformer.planning import CancelToken, Progress, Snapshot
from planformer.serve.answers import region_answer
from planformer.serve.errors import body_of
from planformer.serve.plans import Run, answer, check_problem, execute
from planformer.serve.responses import ProgressResponse, RegionResponse
from planformer.serve.service import Service
from planformer.serve.tree_updates import TreeUpdates

_AT_WORK = b": at work\n\n"
"""A comment, which readers of events skip: a planner that tells nothing is not a dead server."""


async def plan_events(service: Service, request: Request, run: Run) -> AsyncIterator[bytes]:
    """The events of one search.

    Raises:
        PlanformerError: Before the first event; later errors are events.
    """
    news = _News(run, service.settings.progress_seconds)
    begun = False

    def search(cancel: CancelToken) -> bytes:
        check_problem(run)
        news.may_come()
        result = execute(
            run, cancel, service.settings, on_region=news.tell_region, progress=news.progress
        )
        service.metrics.count_plan(run.options.planner, result)
        return event("result", answer(run, result))

    async with service.pool.search(request, search) as done:
        while not done.done():
            await asyncio.wait({done}, timeout=service.settings.progress_seconds)
            if done.done() and done.exception() is not None:
                break
            for message in await asyncio.to_thread(news.collect):
                yield message
                begun = True
        try:
            yield await done
        except PlanformerError as error:
            if not begun:
                raise
            yield event("error", body_of(error))


def event(name: str, body: BaseModel) -> bytes:
    """A server-sent event; JSON has no line breaks."""
    return f"event: {name}\ndata: {body.model_dump_json()}\n\n".encode()


class _News:
    """What there is to tell of a search since it was last asked; one thread asks at a time."""

    def __init__(self, run: Run, interval: float) -> None:
        self.progress = Progress(interval=interval, keep_tree=run.options.tree)
        self._run = run
        self._checked = False
        self._region: RegionResponse | None = None
        self._last: Snapshot | None = None
        self._tree = TreeUpdates(run.ends.robot.robot())

    def may_come(self) -> None:
        """Note that nothing is wrong with the request; from the search's thread."""
        self._checked = True

    def tell_region(self, region: Region, seconds: float) -> None:
        """Note the region; from the search's thread."""
        if self._run.options.region and self._run.guide is not None:
            self._region = region_answer(region, self._run.guide, seconds)

    def collect(self) -> list[bytes]:
        """The events that are due."""
        events = []
        if self._region is not None:
            events.append(event("region", self._region))
            self._region = None
        snapshot = self.progress.latest()
        if snapshot is None:
            events += [_AT_WORK] * self._checked
        elif self._last is None or snapshot.seconds > self._last.seconds:
            events.append(event("progress", self._progress(snapshot)))
            self._last = snapshot
        return events

    def _progress(self, snapshot: Snapshot) -> ProgressResponse:
        has_path = len(snapshot.path) > 0
        is_new = has_path and (self._last is None or snapshot.length < self._last.length)
        return ProgressResponse(
            seconds=snapshot.seconds,
            length=snapshot.length if has_path else None,
            vertices=snapshot.vertices,
            path=snapshot.path.tolist() if is_new else None,
            tree=None if snapshot.tree is None else self._tree.update(snapshot.tree),
        )
