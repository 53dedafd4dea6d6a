"""`planformer map`: generate a map and save it."""

from __future__ import annotations

from enum import Enum
from pathlib import Path
from typing import Annotated

import typer

from planformer.cli.console import print_facts, print_json


class MapKind(str, Enum):
    """Generators by their name on the command line."""

    INDOOR = "indoor"
    FOREST = "forest"
    MAZE = "maze"


def map_command(
    kind: Annotated[
        MapKind, typer.Argument(help="An indoor floor plan, a random forest or a maze.")
    ],
    output: Annotated[
        Path, typer.Option(metavar="FILE", help="File to write: .yaml (with .pgm), .npy or .png.")
    ],
    seed: Annotated[int, typer.Option(min=0, help="The same seed gives the same map.")] = 0,
    width: Annotated[float, typer.Option(help="Extent along x in metres.")] = 24.0,
    height: Annotated[float, typer.Option(help="Extent along y in metres.")] = 24.0,
    resolution: Annotated[float, typer.Option(help="Side of a cell in metres.")] = 0.05,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON and nothing else.")] = False,
) -> None:
    """Generate a map and save it.

    Example: planformer map indoor --seed 1 --output office.yaml
    """
    from planformer.cli.facts import map_facts, map_record
    from planformer.maps import generate_forest, generate_indoor, generate_maze, save_map

    generators = {
        MapKind.INDOOR: generate_indoor,
        MapKind.FOREST: generate_forest,
        MapKind.MAZE: generate_maze,
    }
    grid = generators[kind](seed, width=width, height=height, resolution=resolution)
    output.parent.mkdir(parents=True, exist_ok=True)
    save_map(grid, output)
    if as_json:
        print_json({"kind": kind.value, "seed": seed, **map_record(output, grid)})
    else:
        print_facts(f"{kind.value} map, seed {seed}", map_facts(output, grid))
