"""Refuses requests that other sites' pages let a browser send."""

from __future__ import annotations

from urllib.parse import urlsplit

from starlette.datastructures import Headers
from starlette.types import ASGIApp, Receive, Scope, Send

from planformer.serve.errors import refusal
from planformer.serve.responses import ErrorBody


class GuardHosts:
    """ASGI middleware that checks by which name the service is addressed, and from which page.

    A site can let its own name point to this machine (DNS rebinding) or send a form here; both
    show in the headers Host and Origin.

    Args:
        app: What is guarded.
        hosts: The names that are allowed.
    """

    def __init__(self, app: ASGIApp, hosts: tuple[str, ...]) -> None:
        self._app, self._hosts = app, hosts

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on, or refuse it."""
        if scope["type"] == "http":
            headers = Headers(scope=scope)
            names = [_host_name(f"//{headers.get('host', '')}")]
            if "origin" in headers:
                names.append(_host_name(headers["origin"]))
            if not all(name in self._hosts for name in names):
                message = f"only pages of {', '.join(self._hosts)} may use this service"
                response = refusal(403, ErrorBody(error="ForeignOrigin", message=message))
                await response(scope, receive, send)
                return
        await self._app(scope, receive, send)


def _host_name(url: str) -> str | None:
    try:
        return urlsplit(url).hostname
    except ValueError:
        return None
