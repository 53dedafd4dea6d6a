"""Run the service by itself, until a signal ends it."""

from __future__ import annotations

import asyncio
import signal
import socket
from collections.abc import Callable

import uvicorn

from planformer.errors import InvalidParameter
from planformer.serve.app import create_app
from planformer.serve.settings import ServeSettings

_GRACE_SECONDS = 5
_ENDING = (signal.SIGINT, signal.SIGTERM)


def serve(
    settings: ServeSettings, *, host: str, port: int, on_start: Callable[[str], None]
) -> None:
    """Serve until SIGINT or SIGTERM; then running searches are cancelled and streams end.

    Args:
        settings: Limits.
        host: Address to listen on.
        port: Port to listen on; 0 takes a free one.
        on_start: Gets the address of the page once it can be opened.

    Raises:
        InvalidParameter: The address is taken or not this machine's.
    """
    app = create_app(settings)
    listener = _listen(host, port)
    config = uvicorn.Config(
        app,
        log_level="warning",
        access_log=False,
        limit_concurrency=settings.connections,
        timeout_graceful_shutdown=_GRACE_SECONDS,
    )
    server = _Server(config, app.state.service.close, lambda: on_start(_url(listener)))
    # Uvicorn ends at these signals and raises them again when it has: to end is no failure here.
    before = {number: signal.signal(number, lambda *_: None) for number in _ENDING}
    try:
        asyncio.run(server.serve(sockets=[listener]))
    finally:  # a second signal ends the wait for a map that is being decoded
        for number, handler in before.items():
            signal.signal(number, handler)


class _Server(uvicorn.Server):
    """Cancels searches before it waits for their requests to end."""

    def __init__(
        self, config: uvicorn.Config, close: Callable[[], None], on_start: Callable[[], None]
    ) -> None:
        super().__init__(config)
        self._close, self._on_start = close, on_start

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        await super().startup(sockets)
        self._on_start()

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        self._close()
        await super().shutdown(sockets)


def _listen(host: str, port: int) -> socket.socket:
    try:
        family = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0][0]
        listener = socket.create_server((host, port), family=family, backlog=2048)
        # asyncio does so only for sockets that name their protocol; without it each answer waits
        # 40 ms for the client to acknowledge its headers. Accepted connections inherit it.
        listener.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        return listener
    except (OSError, OverflowError) as error:
        reason = getattr(error, "strerror", None) or error
        raise InvalidParameter(f"cannot listen on {host}, port {port}: {reason}") from error


def _url(listener: socket.socket) -> str:
    host, port = listener.getsockname()[:2]
    return f"http://[{host}]:{port}" if ":" in host else f"http://{host}:{port}"
