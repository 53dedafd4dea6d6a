"""Routes of maps."""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated

from fastapi import APIRouter, File, Form, Header, Path, Response, UploadFile
from pydantic import FiniteFloat

from planformer.errors import InvalidMap, TooLarge
from planformer.maps import OccupancyGrid, generate_forest, generate_indoor, generate_maze
from planformer.serve.edits import edit
from planformer.serve.errors import documented
from planformer.serve.pictures import map_png
from planformer.serve.requests import EditRequest, GenerateRequest, MapId, MapKind
from planformer.serve.responses import MapInfo, MapSource
from planformer.serve.served_map import ServedMap
from planformer.serve.service import Service
from planformer.serve.uploads import read_upload

_GENERATORS: dict[MapKind, Callable[..., OccupancyGrid]] = {
    "forest": generate_forest,
    "maze": generate_maze,
    "indoor": generate_indoor,
}
_WAITING = (429, 503)
"""What all that waits for a thread may be answered with."""
_FOREVER = "public, max-age=31536000, immutable"


def map_routes(service: Service) -> APIRouter:
    """The routes under /maps."""
    routes = APIRouter(prefix="/maps", tags=["maps"])
    settings, store = service.settings, service.store

    @routes.get("", summary="List the maps")
    async def list_maps() -> list[MapInfo]:
        return store.list()

    @routes.post(
        "",
        status_code=201,
        summary="Upload a map",
        responses=documented(400, 403, 413, 422, 507, *_WAITING),
    )
    async def upload(
        files: Annotated[
            list[UploadFile],
            File(description="A picture, a MovingAI .map, or a ROS .yaml and its picture."),
        ],
        resolution: Annotated[
            FiniteFloat | None,
            Form(gt=0.0, description="Side of a cell [m] where the format has none; 0.05."),
        ] = None,
    ) -> MapInfo:
        contents = {file.filename or "": await file.read() for file in files}
        if len(contents) < len(files):
            raise InvalidMap("two files have the same name")

        def read() -> MapInfo:
            served = read_upload(contents, resolution=resolution, map_cells=settings.map_cells)
            return store.add(served, keep=True)

        return await service.in_thread(read)

    @routes.post(
        "/generate",
        status_code=201,
        summary="Generate a map",
        responses=documented(400, 413, 422, *_WAITING),
    )
    async def generate(request: GenerateRequest) -> MapInfo:
        cells = request.width / request.resolution * (request.height / request.resolution)
        if cells > settings.map_cells:
            raise TooLarge(
                f"{cells:.3g} cells are more than the {settings.map_cells:,} of a map here"
            )

        def make() -> MapInfo:
            grid = _GENERATORS[request.kind](
                request.seed,
                width=request.width,
                height=request.height,
                resolution=request.resolution,
            )
            source = MapSource(**request.model_dump())
            return store.add(ServedMap(f"{request.kind} {request.seed}", grid, source))

        return await service.in_thread(make)

    @routes.get("/{map_id}", summary="Describe a map", responses=documented(404, 422, *_WAITING))
    async def describe(map_id: Annotated[MapId, Path()]) -> MapInfo:
        return (await service.in_thread(lambda: store.get(map_id))).info

    @routes.get(
        "/{map_id}/image",
        summary="A map as a picture",
        description="8-bit grey: 0 occupied, 127 unknown, 255 free; the first row has the highest "
        "y of the map's own frame.",
        response_class=Response,
        responses={
            200: {"content": {"image/png": {}}},
            304: {"description": "The picture that the client has is the map's."},
            **documented(404, 422, *_WAITING),
        },
    )
    async def image(
        map_id: Annotated[MapId, Path()], if_none_match: Annotated[str | None, Header()] = None
    ) -> Response:
        headers = {"ETag": f'"{map_id}"', "Cache-Control": _FOREVER}
        if if_none_match is not None and headers["ETag"] in if_none_match:
            return Response(status_code=304, headers=headers)
        png = await service.in_thread(lambda: map_png(store.get(map_id).grid))
        return Response(png, media_type="image/png", headers=headers)

    @routes.post(
        "/{map_id}/edit",
        status_code=201,
        summary="Draw on a map; the result is a new one",
        responses=documented(400, 404, 413, 422, *_WAITING),
    )
    async def draw(map_id: Annotated[MapId, Path()], request: EditRequest) -> MapInfo:
        if (points := sum(len(stroke.points) for stroke in request.strokes)) > (
            settings.stroke_points
        ):
            raise TooLarge(f"{points} points are more than the {settings.stroke_points} of an edit")

        def make() -> MapInfo:
            served = store.get(map_id)
            return store.add(ServedMap(served.name, edit(served.grid, request.strokes)))

        return await service.in_thread(make)

    @routes.delete(
        "/{map_id}",
        status_code=204,
        summary="Forget a map",
        responses=documented(403, 404, 422, *_WAITING),
    )
    async def delete(map_id: Annotated[MapId, Path()]) -> None:
        await service.in_thread(lambda: store.delete(map_id))

    return routes
