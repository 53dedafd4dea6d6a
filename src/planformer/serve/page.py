"""The page: files that were built from web/ and lie in this package."""

from __future__ import annotations

from pathlib import Path

from fastapi import FastAPI
from fastapi.responses import FileResponse, PlainTextResponse, Response
from fastapi.staticfiles import StaticFiles

_PAGE = Path(__file__).resolve().parent / "page"
_POLICY = (
    "default-src 'self'; img-src 'self' data: blob:; style-src 'self' 'unsafe-inline'; "
    "object-src 'none'; base-uri 'none'; frame-ancestors 'none'"
)


def serve_page(app: FastAPI) -> None:
    """Serve the page at / and its files below /assets."""
    if (_PAGE / "assets").is_dir():
        app.mount("/assets", StaticFiles(directory=_PAGE / "assets"), name="assets")

    @app.get("/", include_in_schema=False)
    async def page() -> Response:
        index = _PAGE / "index.html"
        if not index.is_file():
            return PlainTextResponse(
                "The page has not been built: run `make web` in a checkout. The API is at /docs.\n"
            )
        headers = {"Content-Security-Policy": _POLICY, "Cache-Control": "no-cache"}
        return FileResponse(index, headers=headers)
