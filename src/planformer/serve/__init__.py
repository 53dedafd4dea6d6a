"""The planning service: an HTTP API, and the page that it serves."""

from planformer.errors import MissingExtra

try:
    import fastapi as _fastapi  # noqa: F401
    import fastapi_offline as _fastapi_offline  # noqa: F401
    import prometheus_client as _prometheus_client  # noqa: F401
    import python_multipart as _python_multipart  # noqa: F401
    import uvicorn as _uvicorn  # noqa: F401
except ImportError as error:
    raise MissingExtra(error.name or "fastapi", "serve") from error

from planformer.serve.app import create_app
from planformer.serve.server import serve
from planformer.serve.settings import ServeSettings

__all__ = ["ServeSettings", "create_app", "serve"]
