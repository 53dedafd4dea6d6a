"""What the service answers; metres, radians and seconds."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import BaseModel, Field

from planformer.serve.requests import MapKind


class Response(BaseModel):
    """A response body."""


class ErrorBody(Response):
    """Why a request failed."""

    error: Annotated[
        str, Field(description="Name of the error, as in planformer.errors where it has one.")
    ]
    message: Annotated[str, Field(description="What is wrong, and what would be right.")]
    details: Annotated[
        dict[str, Any],
        Field(description="nearest_free: the closest free point [x, y] [m], where there is one."),
    ] = {}


class Health(Response):
    """That the service runs."""

    status: str
    version: str


class MapSource(Response):
    """How a map can be made again."""

    kind: MapKind
    seed: int
    width: Annotated[float, Field(description="Extent along x [m].")]
    height: Annotated[float, Field(description="Extent along y [m].")]
    resolution: Annotated[float, Field(description="Side of a cell [m].")]


class MapInfo(Response):
    """A map."""

    id: Annotated[str, Field(description="16 hex digits made of the map's content.")]
    name: str
    rows: int
    columns: int
    resolution: Annotated[float, Field(description="Side of a cell [m].")]
    origin: Annotated[
        tuple[float, float, float],
        Field(description="World pose (x, y, yaw) of the lower-left corner [m, rad]."),
    ]
    width: Annotated[float, Field(description="Extent along the map's own x axis [m].")]
    height: Annotated[float, Field(description="Extent along the map's own y axis [m].")]
    occupied: Annotated[float, Field(description="Share of the cells that are occupied, 0 to 1.")]
    source: Annotated[
        MapSource | None, Field(description="The request that generated the map; null for others.")
    ] = None


class RegionResponse(Response):
    """Where a network expects a good path."""

    guide: str
    rows: Annotated[int, Field(description="Rows of anchors; row 0 has the lowest y.")]
    columns: int
    probability: Annotated[list[float], Field(description="Of each anchor, row by row.")]
    anchors: Annotated[list[list[float]], Field(description="[x, y] [m], row by row.")]
    anchor_size: Annotated[float, Field(description="Distance of neighbouring anchors [m].")]
    mask: Annotated[
        str,
        Field(description="Base64 of a PNG laid out as the map's image, white inside the region."),
    ]
    threshold: Annotated[float, Field(description="Anchors as probable make up the region.")]
    connected: Annotated[
        bool, Field(description="Whether start and goal are connected within the region.")
    ]
    proposal_seconds: Annotated[float, Field(description="Wall-clock time of the proposal [s].")]


class TreeResponse(Response):
    """A search tree or roadmap."""

    vertices: Annotated[list[float], Field(description="x0, y0, x1, y1, ... [m], rounded to mm.")]
    parents: Annotated[list[int], Field(description="Of each vertex; -1 for a root.")]
    links: Annotated[
        list[int],
        Field(description="Further edges i0, j0, i1, j1, ... of a roadmap; empty for a tree."),
    ] = []
    curves: Annotated[
        list[list[float]],
        Field(
            description="For a car: points x0, y0, x1, y1, ... [m] between the ends of each edge, "
            "those of the vertices, then the links; none where it is straight. Empty for a point "
            "robot."
        ),
    ] = []


class TreeUpdate(Response):
    """What turns the tree of the last event into that of this one.

    Vertices keep their numbers. First drop the vertices from `first` on (0: all), then append.
    """

    first: Annotated[int, Field(description="Number of the first new vertex.")]
    vertices: Annotated[
        list[float], Field(description="The new vertices, x0, y0, x1, y1, ... [m], rounded to mm.")
    ]
    parents: Annotated[list[int], Field(description="Of each new vertex; -1 for a root.")]
    changed: Annotated[
        list[int],
        Field(description="Older vertices with another parent: vertex, parent, vertex, ..."),
    ]
    links: Annotated[
        list[int], Field(description="All further edges of a roadmap, i0, j0, i1, j1, ...")
    ]
    curves: Annotated[
        list[list[float]],
        Field(
            description="For a car: points x0, y0, x1, y1, ... [m] between the ends of each edge, "
            "those of the new vertices, the changed ones, the links; none where it is straight. "
            "Empty for a point robot."
        ),
    ]


class ProgressResponse(Response):
    """What a search has found so far."""

    seconds: Annotated[float, Field(description="Since the search began [s].")]
    length: Annotated[float | None, Field(description="Of the best path [m].")] = None
    vertices: Annotated[int, Field(description="States that the planner holds.")]
    path: Annotated[
        list[list[float]] | None, Field(description="The best path, if it is a new one.")
    ] = None
    tree: Annotated[TreeUpdate | None, Field(description="If it was asked for.")] = None


class PlanResponse(Response):
    """A plan: the library's `PlanResult`."""

    solved: Annotated[bool, Field(description="Whether a valid path was found.")]
    status: Annotated[str, Field(description="Why the search ended.")]
    path: Annotated[
        list[list[float]],
        Field(description="(x, y) or (x, y, yaw) [m, rad]; a car's poses are dense."),
    ]
    length: Annotated[float | None, Field(description="Length of the path [m].")]
    vertices: Annotated[int, Field(description="States in the search tree.")]
    planning_seconds: Annotated[
        float, Field(description="Search, its set-up and the path's check [s].")
    ]
    proposal_seconds: Annotated[float, Field(description="Region proposal [s].")]
    total_seconds: Annotated[float, Field(description="Both together [s].")]
    planner: str
    guide: Annotated[str | None, Field(description="Guide of the search; null without one.")]
    seed: Annotated[int, Field(description="Seed of the search, also where none was asked for.")]
    region: RegionResponse | None = None
    tree: TreeResponse | None = None


class CompareResponse(Response):
    """Plans in the order of the runs."""

    results: list[PlanResponse]


class RobotOptions(Response):
    """What there is for a robot."""

    planners: list[str]
    guides: list[str]
    default_planner: str
    default_guide: str
    unguided_planners: Annotated[
        list[str], Field(description="Planners that do without a guide: they learned to plan.")
    ]


class Limits(Response):
    """What the service may be asked for."""

    upload_bytes: int
    map_cells: int
    plan_seconds: Annotated[float, Field(description="Longest time limit [s].")]
    plan_vertices: int
    plans: Annotated[int, Field(description="Searches at once.")]
    runs_to_compare: int
    stroke_points: int


class Options(Response):
    """What the service can do."""

    version: str
    robots: dict[str, RobotOptions]
    map_kinds: list[str]
    limits: Limits
