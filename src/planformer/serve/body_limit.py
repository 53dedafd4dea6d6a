"""Refuses request bodies that are too large, before they take memory."""

from __future__ import annotations

from starlette.datastructures import Headers
from starlette.exceptions import HTTPException
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from planformer.errors import TooLarge
from planformer.serve.errors import body_of, refusal
from planformer.serve.settings import ServeSettings

_READ_ANYWAY = 4
"""A body up to this many times the limit is read to its end and dropped: a client that is cut off
while it sends does not see the answer."""


class LimitBodies:
    """ASGI middleware that bounds bodies: those of uploads, and all others."""

    def __init__(self, app: ASGIApp, settings: ServeSettings) -> None:
        self._app, self._settings = app, settings

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass a request on, or refuse it."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        limit = self._limit(scope["path"])
        received = 0

        async def counted() -> Message:
            nonlocal received
            message = await receive()
            received += len(message.get("body", b""))
            if received > limit:
                if message.get("more_body", False):
                    await _drop(receive, (_READ_ANYWAY - 1) * limit)
                raise HTTPException(413, str(_error(limit)))
            return message

        length = Headers(scope=scope).get("content-length", "")
        if length.isdecimal() and int(length[:20]) > _READ_ANYWAY * limit:
            await refusal(413, body_of(_error(limit)))(scope, receive, send)
            return
        await self._app(scope, counted, send)

    def _limit(self, path: str) -> int:
        is_upload = path.endswith("/maps")
        return self._settings.upload_bytes if is_upload else self._settings.body_bytes


def _error(limit: int) -> TooLarge:
    return TooLarge(f"the request's body is larger than the {limit:,} bytes that are allowed")


async def _drop(receive: Receive, most: int) -> None:
    dropped, more = 0, True
    while more and dropped <= most:
        message = await receive()
        dropped += len(message.get("body", b""))
        more = message.get("more_body", False)
