"""`planformer info`: what this installation can do, or what a map is."""

from __future__ import annotations

import importlib.metadata
import platform
from pathlib import Path
from typing import Annotated, Any

import typer

import planformer
from planformer.cli.console import print_facts, print_json, stdout
from planformer.errors import PlanformerError

_PACKAGES = ("numpy", "onnxruntime", "matplotlib", "torch")


def info_command(
    map_file: Annotated[
        Path | None, typer.Argument(metavar="MAP", help="Describe this map.")
    ] = None,
    resolution: Annotated[
        float | None, typer.Option(help="Metres a cell of a map that does not state it.")
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON and nothing else.")] = False,
) -> None:
    """Show versions, planners and guides; with MAP, describe the map."""
    if map_file is not None:
        _show_map(map_file, resolution, as_json=as_json)
    elif as_json:
        print_json(_installation())
    else:
        _print_installation(_installation())


def _show_map(file: Path, resolution: float | None, *, as_json: bool) -> None:
    from planformer.cli.facts import map_facts, map_record
    from planformer.maps import load_map

    grid = load_map(file, resolution=resolution)
    if as_json:
        print_json(map_record(file, grid))
    else:
        print_facts(file.stem, map_facts(file, grid))


def _installation() -> dict[str, Any]:
    from planformer.api import planner_names
    from planformer.cli.plan import RobotKind, make_robot
    from planformer.guidance import guide_names

    return {
        "planformer": planformer.__version__,
        "python": platform.python_version(),
        "packages": {name: _version(name) for name in _PACKAGES},
        "planners": {kind.value: planner_names(make_robot(kind, None, None)) for kind in RobotKind},
        "guides": {name: _guide(name) for name in guide_names()},
    }


def _version(package: str) -> str | None:
    try:
        return importlib.metadata.version(package)
    except importlib.metadata.PackageNotFoundError:
        return None


def _guide(name: str) -> dict[str, Any]:
    """What the card of shipped weights says, or why they cannot be used."""
    from planformer.guidance.weights import weights_path
    from planformer.weights import read_weights

    try:
        card = read_weights(weights_path(name)).card
    except PlanformerError as error:
        return {"error": str(error)}
    return {key: card.get(key) for key in ("name", "robot", "preset", "accuracy")}


def _print_installation(record: dict[str, Any]) -> None:
    packages = {name: version or "not installed" for name, version in record["packages"].items()}
    title = f"planformer {record['planformer']}"
    print_facts(title, {"python": record["python"], **packages})
    stdout.print()
    print_facts(
        "planners", {robot: ", ".join(names) for robot, names in record["planners"].items()}
    )
    stdout.print()
    print_facts("guides", {name: _guide_words(guide) for name, guide in record["guides"].items()})


def _guide_words(guide: dict[str, Any]) -> str:
    if "error" in guide:
        return str(guide["error"])
    lines = [f"{guide['name']}, {guide['robot']} robot"]
    for kind, metrics in (guide["accuracy"] or {}).items():
        values = ", ".join(f"{name} {value:.3g}" for name, value in metrics.items())
        lines.append(f"{kind}: {values}")
    return "\n".join(lines)
