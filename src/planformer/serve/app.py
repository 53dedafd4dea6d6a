"""The application: routes, limits and errors put together."""

from __future__ import annotations

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from typing import get_args

from fastapi import FastAPI
from fastapi.responses import Response
from fastapi_offline import FastAPIOffline
from prometheus_client import CONTENT_TYPE_LATEST, generate_latest

import planformer
from planformer.serve.body_limit import LimitBodies
from planformer.serve.errors import handle_errors
from planformer.serve.guard import GuardHosts
from planformer.serve.map_routes import map_routes
from planformer.serve.metrics import CountRequests
from planformer.serve.openapi import describe_events
from planformer.serve.page import serve_page
from planformer.serve.plan_routes import plan_routes
from planformer.serve.plans import robot_options
from planformer.serve.requests import MapKind
from planformer.serve.responses import Health, Limits, Options
from planformer.serve.service import Service
from planformer.serve.settings import ServeSettings

_DESCRIPTION = """
Maps, region proposals and plans over HTTP; the same calls as the Python library's.

Lengths are in metres, angles in rad, times in seconds, points in the map's world frame (x right,
y up). Every error has the body `ErrorBody`.
"""


def create_app(settings: ServeSettings | None = None) -> FastAPI:
    """Make the application, to run by itself or inside another.

    Args:
        settings: Its limits; the defaults if None.

    Returns:
        The application. Its `state.service.close()` ends running searches; it is called when the
        application's lifespan ends.

    Raises:
        InvalidParameter: The folder of maps cannot be made.
    """
    service = Service(settings or ServeSettings())
    app = FastAPIOffline(
        title="planformer",
        version=planformer.__version__,
        description=_DESCRIPTION,
        redoc_url=None,
        lifespan=_lifespan,
    )
    app.state.service = service
    handle_errors(app)
    app.include_router(map_routes(service))
    app.include_router(plan_routes(service))
    _service_routes(app, service)
    serve_page(app)
    describe_events(app)
    app.add_middleware(LimitBodies, settings=service.settings)
    app.add_middleware(CountRequests, metrics=service.metrics)
    if service.settings.hosts is not None:
        app.add_middleware(GuardHosts, hosts=service.settings.hosts)
    return app


@asynccontextmanager
async def _lifespan(app: FastAPI) -> AsyncIterator[None]:
    yield
    app.state.service.close()


def _service_routes(app: FastAPI, service: Service) -> None:
    settings = service.settings

    @app.get("/health", tags=["service"], summary="Whether the service runs")
    async def health() -> Health:
        return Health(status="ok", version=planformer.__version__)

    @app.get(
        "/metrics",
        tags=["service"],
        summary="Counters in Prometheus' text format",
        response_class=Response,
        responses={200: {"content": {"text/plain": {}}}},
    )
    async def metrics() -> Response:
        text = generate_latest(service.metrics.registry)
        return Response(text, media_type=CONTENT_TYPE_LATEST)

    @app.get("/options", tags=["service"], summary="Robots, planners, guides and limits")
    async def options() -> Options:
        return Options(
            version=planformer.__version__,
            robots=await service.in_thread(robot_options),
            map_kinds=list(get_args(MapKind)),
            limits=Limits(
                upload_bytes=settings.upload_bytes,
                map_cells=settings.map_cells,
                plan_seconds=settings.plan_seconds,
                plan_vertices=settings.plan_vertices,
                plans=settings.plans,
                runs_to_compare=settings.runs_to_compare,
                stroke_points=settings.stroke_points,
            ),
        )
