"""What the service is asked; metres, radians and seconds."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, FiniteFloat

from planformer.guidance import AUTO
from planformer.robots import DubinsCar, PointRobot, ReedsSheppCar, Robot

MapKind = Literal["forest", "maze", "indoor"]
Radius = Annotated[FiniteFloat, Field(ge=0.0, le=100.0, description="Radius of the robot [m].")]
TurningRadius = Annotated[
    FiniteFloat, Field(gt=0.0, le=1000.0, description="Radius of the tightest circle [m].")
]
State = Annotated[
    list[FiniteFloat],
    Field(min_length=2, max_length=3, description="(x, y) [m]; for a car (x, y, yaw) [m, rad]."),
]
Point = Annotated[list[FiniteFloat], Field(min_length=2, max_length=2)]
MapId = Annotated[
    str,
    Field(
        pattern="^[0-9a-f]{16}$",
        description="Id of a map, made of its content.",
        examples=["0123456789abcdef"],
    ),
]
Threshold = Annotated[
    FiniteFloat | None,
    Field(
        ge=0.0,
        le=1.0,
        description="Probability above which an anchor belongs to the region; null chooses it so "
        "that start and goal are connected.",
    ),
]


class Request(BaseModel):
    """A request body; an unknown key is an error, and so is a word where a number belongs."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)


class Disc(Request):
    """A disc that moves in any direction."""

    kind: Literal["point"] = "point"
    radius: Radius = 0.1

    def robot(self) -> Robot:
        """The library's robot."""
        return PointRobot(self.radius)


class Car(Request):
    """A car with a smallest turning radius: Dubins drives forward, Reeds-Shepp both ways."""

    kind: Literal["dubins", "reeds-shepp"]
    radius: Radius = 0.2
    turning_radius: TurningRadius = 0.55

    def robot(self) -> Robot:
        """The library's robot."""
        make = DubinsCar if self.kind == "dubins" else ReedsSheppCar
        return make(radius=self.radius, turning_radius=self.turning_radius)


class Ends(Request):
    """A problem on a map."""

    map: MapId
    robot: Annotated[Disc | Car, Field(discriminator="kind")] = Disc()
    start: State
    goal: State


class RunOptions(Request):
    """How to search."""

    planner: Annotated[
        str,
        Field(
            max_length=64,
            description='A name from /options, or "auto" for the one that suits the robot.',
        ),
    ] = AUTO
    guide: Annotated[
        str | None,
        Field(
            max_length=128,
            description='A name from /options, "auto" for the one that suits the robot, or null '
            "for a search of the whole map.",
        ),
    ] = AUTO
    threshold: Threshold = None
    exploration: Annotated[
        FiniteFloat, Field(ge=0.0, le=1.0, description="Share of samples from the whole map.")
    ] = 0.0
    time_limit: Annotated[
        FiniteFloat, Field(gt=0.0, description="Wall-clock limit of the search [s].")
    ] = 1.0
    target_length: Annotated[
        FiniteFloat | None, Field(gt=0.0, description="Stop at a path at most this long [m].")
    ] = None
    max_vertices: Annotated[
        int | None, Field(ge=1, description="Stop when the tree holds this many states.")
    ] = None
    seed: Annotated[
        int | None, Field(ge=0, lt=2**32, description="Seed of the search; null draws one.")
    ] = None
    tree: Annotated[bool, Field(description="Whether to return the search tree.")] = False
    region: Annotated[bool, Field(description="Whether to return the proposed region.")] = False


class PlanRequest(Ends, RunOptions):
    """A plan: what `planformer.plan` takes."""


class CompareRequest(Ends):
    """Several searches on one problem, one after the other."""

    runs: Annotated[list[RunOptions], Field(min_length=1, max_length=100)]


class ProposeRequest(Ends):
    """A region proposal without a search."""

    guide: Annotated[
        str,
        Field(
            max_length=128,
            description='A name from /options, or "auto" for the one that suits the robot.',
        ),
    ] = AUTO
    threshold: Threshold = None


Side = Annotated[FiniteFloat, Field(gt=0.0, le=500.0)]  # a forest has trees whatever its cells


class GenerateRequest(Request):
    """A generated map; the same request gives the same map."""

    kind: MapKind
    seed: Annotated[int, Field(ge=0, lt=2**63)] = 0
    width: Annotated[Side, Field(description="Extent along x [m].")] = 24.0
    height: Annotated[Side, Field(description="Extent along y [m].")] = 24.0
    resolution: Annotated[FiniteFloat, Field(gt=0.0, le=0.5, description="Side of a cell [m].")] = (
        0.05
    )


class Stroke(Request):
    """A stroke of a round brush."""

    points: Annotated[list[Point], Field(min_length=1, description="Polyline, [x, y] [m].")]
    radius: Annotated[FiniteFloat, Field(gt=0.0, description="Radius of the brush [m].")]
    occupied: Annotated[bool, Field(description="Draw obstacles, or erase them.")]


class EditRequest(Request):
    """Strokes over a map, in their order."""

    strokes: Annotated[list[Stroke], Field(min_length=1)]
