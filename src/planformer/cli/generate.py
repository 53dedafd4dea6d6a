"""`planformer generate`: make a data set of expert paths."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import Annotated

import typer

from planformer.cli.console import print_facts, print_json


def generate_command(
    output: Annotated[Path, typer.Argument(metavar="FOLDER", help="Folder of the data set.")],
    preset: Annotated[
        str | None, typer.Option(help="The paper's data sets: paper or paper-dubins.")
    ] = None,
    maps: Annotated[int | None, typer.Option(help="Number of generated maps of each kind.")] = None,
    kinds: Annotated[
        str | None, typer.Option(help="Kinds of maps: some of forest,indoor,maze.")
    ] = None,
    maps_from: Annotated[
        Path | None, typer.Option(metavar="FOLDER", help="Use every map file in this folder.")
    ] = None,
    paths_per_map: Annotated[int | None, typer.Option(help="Problems on each map (25).")] = None,
    seed: Annotated[int | None, typer.Option(help="Seed of the data set (0).")] = None,
    width: Annotated[float | None, typer.Option(help="Metres along x of a map (24).")] = None,
    height: Annotated[float | None, typer.Option(help="Metres along y of a map (24).")] = None,
    resolution: Annotated[
        float | None,
        typer.Option(help="Metres a cell of generated maps and of files that state none (0.05)."),
    ] = None,
    robot: Annotated[str | None, typer.Option(help="point or dubins (point).")] = None,
    radius: Annotated[float | None, typer.Option(help="Radius of the robot in metres.")] = None,
    turning_radius: Annotated[
        float | None, typer.Option(help="Radius of the car's tightest circle in metres.")
    ] = None,
    min_distance: Annotated[
        float | None, typer.Option(help="Least metres from start to goal.")
    ] = None,
    max_distance: Annotated[
        float | None, typer.Option(help="Most metres from start to goal.")
    ] = None,
    expert: Annotated[str | None, typer.Option(help="Who solves the problems.")] = None,
    expert_seconds: Annotated[
        float | None, typer.Option(help="The expert's time for each problem.")
    ] = None,
    expert_vertices: Annotated[
        int | None, typer.Option(help="Most states in the expert's tree.")
    ] = None,
    maps_per_shard: Annotated[int | None, typer.Option(help="Maps in a file (25).")] = None,
    workers: Annotated[int, typer.Option(help="Number of processes.")] = 2,
    ray: Annotated[
        str | None,
        typer.Option(metavar="ADDRESS", help='Work on a Ray cluster: "auto" or "local".'),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON and nothing else.")] = False,
) -> None:
    """Generate maps with expert paths to train on; the same command completes an interrupted set.

    Without a preset or --maps-from, forests and mazes are generated. A point robot has a radius of
    0.1 m and goals at least 3 m away; the car 0.2 m, circles of 0.549 m and goals 4 to 15 m away.

    Examples: planformer generate data/train --maps 1000 --seed 1

    planformer generate data/train --preset paper --workers 8
    """
    from planformer.data.generate import generate_dataset

    spec = generate_dataset(
        output,
        preset=preset,
        maps_from=maps_from,
        workers=workers,
        ray_address=ray,
        show_progress=not as_json,
        kinds=None if kinds is None else [kind.strip() for kind in kinds.split(",")],
        maps=maps,
        paths_per_map=paths_per_map,
        seed=seed,
        width=width,
        height=height,
        resolution=resolution,
        robot=robot,
        robot_radius=radius,
        turning_radius=turning_radius,
        min_distance=min_distance,
        max_distance=max_distance,
        expert=expert,
        expert_seconds=expert_seconds,
        expert_vertices=expert_vertices,
        maps_per_shard=maps_per_shard,
    )
    if as_json:
        print_json({"folder": str(output), **asdict(spec)})
        return
    names = [*spec.kinds, *(["your own"] if spec.user_maps else [])]
    print_facts(
        "data set complete",
        {
            "folder": str(output),
            "maps": f"{spec.total_maps:,} ({', '.join(names)})",
            "paths": f"{spec.total_maps * spec.paths_per_map:,}",
            "robot": spec.robot,
            "expert": spec.expert,
        },
    )
