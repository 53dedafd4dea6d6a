"""The description of the API, with what FastAPI leaves out: the bodies of events."""

from __future__ import annotations

from typing import Any

from fastapi import FastAPI
from pydantic import BaseModel
from pydantic.json_schema import models_json_schema

from planformer.serve.responses import ErrorBody, PlanResponse, ProgressResponse, RegionResponse

_BODIES: dict[str, type[BaseModel]] = {
    "region": RegionResponse,
    "progress": ProgressResponse,
    "result": PlanResponse,
    "error": ErrorBody,
}
_REFERENCE = "#/components/schemas/{model}"

EVENT: dict[str, Any] = {
    "type": "object",
    "required": ["event", "data"],
    "properties": {
        "event": {"enum": list(_BODIES)},
        "data": {
            "type": "string",
            "contentMediaType": "application/json",
            "contentSchema": {
                "oneOf": [
                    {"$ref": _REFERENCE.format(model=body.__name__)} for body in _BODIES.values()
                ]
            },
        },
    },
}
"""The schema of an event of a stream."""


def describe_events(app: FastAPI) -> None:
    """Add the bodies of events to an application's description."""
    describe = app.openapi

    def openapi() -> dict[str, Any]:
        schema = describe()
        _, bodies = models_json_schema(
            [(body, "serialization") for body in _BODIES.values()], ref_template=_REFERENCE
        )
        for name, body in bodies["$defs"].items():
            schema["components"]["schemas"].setdefault(name, body)
        return schema

    app.openapi = openapi  # type: ignore[method-assign]  # as FastAPI's documentation extends it
