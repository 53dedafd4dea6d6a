"""Routes of proposals and plans."""

from __future__ import annotations

from collections.abc import AsyncIterator

from fastapi import APIRouter, Request
from fastapi.responses import Response, StreamingResponse

from planformer.errors import InvalidParameter
from planformer.planning import CancelToken
from planformer.serve.errors import documented
from planformer.serve.openapi import EVENT
from planformer.serve.plans import Run, answer, check_run, execute, propose
from planformer.serve.requests import CompareRequest, PlanRequest, ProposeRequest
from planformer.serve.responses import CompareResponse, PlanResponse, RegionResponse
from planformer.serve.service import Service
from planformer.serve.stream import plan_events

_ERRORS = documented(400, 404, 422, 429, 503)
_EVENTS = """
Server-sent events. `region`: a RegionResponse, if asked for. `progress`, some 15 a second: a
ProgressResponse. Then `result`: a PlanResponse, or `error`: an ErrorBody. What is wrong with a
request is an ordinary error response.
"""


def plan_routes(service: Service) -> APIRouter:
    """The routes /propose, /plan and /compare."""
    routes = APIRouter(tags=["planning"])
    settings, pool = service.settings, service.pool

    def search(run: Run, cancel: CancelToken) -> PlanResponse:
        result = execute(run, cancel, settings)
        service.metrics.count_plan(run.options.planner, result)
        return answer(run, result)

    @routes.post(
        "/propose",
        summary="Propose a region",
        response_model=RegionResponse,
        responses=_ERRORS,
    )
    async def propose_region(request: Request, body: ProposeRequest) -> Response:
        grid = await service.grid(body.map)
        return await pool.run(request, lambda cancel: _json(propose(grid, body)))

    @routes.post(
        "/plan",
        summary="Plan a path",
        description="As `planformer.plan`. The search ends when the client goes away.",
        response_model=PlanResponse,
        responses=_ERRORS,
    )
    async def plan(request: Request, body: PlanRequest) -> Response:
        run = check_run(await service.grid(body.map), body, body, settings)
        return await pool.run(request, lambda cancel: _json(search(run, cancel)))

    @routes.post(
        "/plan/stream",
        summary="Plan a path and see it found",
        description=_EVENTS,
        response_class=StreamingResponse,
        responses={
            200: {"content": {"text/event-stream": {"schema": EVENT}}},
            **_ERRORS,
        },
    )
    async def plan_stream(request: Request, body: PlanRequest) -> StreamingResponse:
        run = check_run(await service.grid(body.map), body, body, settings)
        events = plan_events(service, request, run)
        first = await anext(events)
        headers = {"Cache-Control": "no-store", "X-Accel-Buffering": "no"}
        return StreamingResponse(
            _chained(first, events), media_type="text/event-stream", headers=headers
        )

    @routes.post(
        "/compare",
        summary="Plan one problem several times",
        description="One search after the other, so that their times compare.",
        response_model=CompareResponse,
        responses=_ERRORS,
    )
    async def compare(request: Request, body: CompareRequest) -> Response:
        if len(body.runs) > settings.runs_to_compare:
            raise InvalidParameter(
                f"at most {settings.runs_to_compare} runs can be compared; got {len(body.runs)}"
            )
        grid = await service.grid(body.map)
        runs = [check_run(grid, body, options, settings) for options in body.runs]
        return await pool.run(
            request,
            lambda cancel: _json(CompareResponse(results=[search(run, cancel) for run in runs])),
        )

    return routes


async def _chained(first: bytes, rest: AsyncIterator[bytes]) -> AsyncIterator[bytes]:
    yield first
    async for message in rest:
        yield message


def _json(body: PlanResponse | RegionResponse | CompareResponse) -> Response:
    """The finished response: made in the search's thread, because a tree's JSON takes a while."""
    return Response(body.model_dump_json(), media_type="application/json")
