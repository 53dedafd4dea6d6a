"""What the service measures, in Prometheus' text format."""

from __future__ import annotations

import time

from prometheus_client import CollectorRegistry, Counter, Gauge, Histogram, ProcessCollector
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from planformer.planning import PlanResult
from planformer.serve.pool import PlanPool
from planformer.serve.store import MapStore

_SECONDS = (0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0)
_METHODS = frozenset({"DELETE", "GET", "HEAD", "OPTIONS", "PATCH", "POST", "PUT"})


class Metrics:
    """Counters of one service.

    Args:
        pool: The searches.
        store: The maps.
    """

    def __init__(self, pool: PlanPool, store: MapStore) -> None:
        self.registry = CollectorRegistry()
        ProcessCollector(registry=self.registry)
        self._requests = Counter(
            "planformer_requests",
            "Requests by route and status.",
            ["method", "route", "status"],
            registry=self.registry,
        )
        self._request_seconds = Histogram(
            "planformer_request_seconds",
            "Time to the end of the response, by route.",
            ["route"],
            buckets=_SECONDS,
            registry=self.registry,
        )
        self._plans = Counter(
            "planformer_plans",
            "Plans by planner and status.",
            ["planner", "status"],
            registry=self.registry,
        )
        self._plan_seconds = Histogram(
            "planformer_plan_seconds",
            "Search and proposal together, by planner.",
            ["planner"],
            buckets=_SECONDS,
            registry=self.registry,
        )
        running = Gauge("planformer_plans_running", "Searches now.", registry=self.registry)
        running.set_function(lambda: pool.running)
        cells = Gauge("planformer_map_cells", "Cells in memory.", registry=self.registry)
        cells.set_function(lambda: store.cells)

    def count_plan(self, planner: str, result: PlanResult) -> None:
        """Count a search that has ended."""
        self._plans.labels(planner, result.status.value).inc()
        seconds = result.planning_seconds + result.proposal_seconds
        self._plan_seconds.labels(planner).observe(seconds)

    def count_request(self, method: str, route: str, status: int, seconds: float) -> None:
        """Count a request that has been answered."""
        self._requests.labels(method, route, str(status)).inc()
        self._request_seconds.labels(route).observe(seconds)


class CountRequests:
    """ASGI middleware that counts requests by the template of their route."""

    def __init__(self, app: ASGIApp, metrics: Metrics) -> None:
        self._app, self._metrics = app, metrics

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on and count it."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        started, status = time.perf_counter(), 500

        async def watch(message: Message) -> None:
            nonlocal status
            if message["type"] == "http.response.start":
                status = message["status"]
            await send(message)

        try:
            await self._app(scope, receive, watch)
        finally:
            # Without a route a path is anyone's invention, as the method may be, and every one
            # would be a new series.
            route = getattr(scope.get("route"), "path", "other")
            seconds = time.perf_counter() - started
            method = scope["method"] if scope["method"] in _METHODS else "other"
            self._metrics.count_request(method, route, status, seconds)
