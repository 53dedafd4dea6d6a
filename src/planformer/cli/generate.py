"""`planformer generate`: make a data set of expert paths."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import Annotated

import typer

from planformer.cli.console import print_facts, print_json


def generate_command(
    output: Annotated[Path, typer.Argument(metavar="FOLDER", help="Folder of the data set.")],
    maps: Annotated[int, typer.Option(help="Number of maps of each kind.")],
    kinds: Annotated[str, typer.Option(help="Kinds of maps, separated by commas.")] = "forest,maze",
    paths_per_map: Annotated[int, typer.Option(help="Problems on each map.")] = 25,
    seed: Annotated[int, typer.Option(help="Seed of the data set.")] = 0,
    radius: Annotated[float, typer.Option(help="Radius of the robot in metres.")] = 0.1,
    workers: Annotated[int, typer.Option(help="Number of processes.")] = 2,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON and nothing else.")] = False,
) -> None:
    """Generate maps with expert paths to train on; the same command completes an interrupted set.

    Example: planformer generate data/train --maps 1000 --seed 1
    """
    from planformer.data.generate import generate_dataset

    spec = generate_dataset(
        output,
        kinds=[kind.strip() for kind in kinds.split(",")],
        maps=maps,
        paths_per_map=paths_per_map,
        seed=seed,
        robot_radius=radius,
        workers=workers,
        show_progress=not as_json,
    )
    if as_json:
        print_json({"folder": str(output), **asdict(spec)})
        return
    count = len(spec.kinds) * spec.maps
    print_facts(
        "data set complete",
        {
            "folder": str(output),
            "maps": f"{count:,} ({', '.join(spec.kinds)})",
            "paths": f"{count * spec.paths_per_map:,}",
        },
    )
