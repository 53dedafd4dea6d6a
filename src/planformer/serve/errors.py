"""Errors as HTTP responses: every one has the same body."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import JSONResponse
from starlette.exceptions import HTTPException

from planformer.errors import (
    Busy,
    PlanformerError,
    RequestRefused,
    ShuttingDown,
    StoreFull,
    TooLarge,
    UnknownMap,
)
from planformer.serve.responses import ErrorBody

_STATUS: dict[type[PlanformerError], int] = {
    UnknownMap: 404,
    TooLarge: 413,
    Busy: 429,
    ShuttingDown: 503,
    StoreFull: 507,
    RequestRefused: 403,
    PlanformerError: 400,
}
"""The first entry that fits decides."""

_NAMES = {404: "NotFound", 405: "MethodNotAllowed", 413: "TooLarge"}
"""Names of errors that the framework finds."""
_RETRY_SECONDS = {429: "1", 503: "5"}
_SHOWN_PROBLEMS = 3


def documented(*codes: int) -> dict[int | str, dict[str, Any]]:
    """Error responses of a route for its OpenAPI description."""
    return {code: {"model": ErrorBody} for code in codes}


def status_of(error: PlanformerError) -> int:
    """The HTTP status of a typed error."""
    return next(status for kind, status in _STATUS.items() if isinstance(error, kind))


def body_of(error: PlanformerError) -> ErrorBody:
    """The body of a typed error."""
    nearest = getattr(error, "nearest_free", None)
    details = {} if nearest is None else {"nearest_free": list(nearest)}
    return ErrorBody(error=type(error).__name__, message=str(error), details=details)


def refusal(status: int, body: ErrorBody) -> JSONResponse:
    """The response of an error."""
    retry = _RETRY_SECONDS.get(status)
    headers = {} if retry is None else {"Retry-After": retry}
    return JSONResponse(body.model_dump(), status, headers=headers)


def handle_errors(app: FastAPI) -> None:
    """Let the application answer errors with an `ErrorBody`."""

    @app.exception_handler(PlanformerError)
    async def typed(request: Request, error: PlanformerError) -> JSONResponse:
        return refusal(status_of(error), body_of(error))

    @app.exception_handler(RequestValidationError)
    async def malformed(request: Request, error: RequestValidationError) -> JSONResponse:
        message = _problems(error.errors())
        return refusal(422, ErrorBody(error="MalformedRequest", message=message))

    @app.exception_handler(HTTPException)
    async def http(request: Request, error: HTTPException) -> JSONResponse:
        name = _NAMES.get(error.status_code, "MalformedRequest")
        body = ErrorBody(error=name, message=str(error.detail))
        response = refusal(error.status_code, body)
        response.headers.update(error.headers or {})
        return response

    @app.exception_handler(Exception)
    async def unforeseen(request: Request, error: Exception) -> JSONResponse:
        message = "the server made a mistake; its log says more"
        return refusal(500, ErrorBody(error="InternalError", message=message))


def _problems(errors: Sequence[Any]) -> str:
    """What is wrong with a request, without the values: they may be huge or no JSON."""
    words = [f"{'.'.join(map(str, error['loc']))}: {error['msg']}" for error in errors]
    more = len(words) - _SHOWN_PROBLEMS
    return "; ".join(words[:_SHOWN_PROBLEMS]) + (f"; and {more} more" if more > 0 else "")
