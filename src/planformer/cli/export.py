"""`planformer export`: turn a training's checkpoint into weights that guide plans."""

from __future__ import annotations

import importlib
from pathlib import Path
from typing import Annotated

import typer

from planformer.cli.console import print_facts, print_json


def export_command(
    checkpoint: Annotated[
        Path, typer.Argument(metavar="CHECKPOINT", help="checkpoint.pt of a training.")
    ],
    output: Annotated[
        Path, typer.Argument(metavar="FILE", help="File *.onnx to write; a card *.json is added.")
    ],
    name: Annotated[
        str | None, typer.Option(help="Name of the weights. Default: the file's.")
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON and nothing else.")] = False,
) -> None:
    """Export trained weights for ONNX Runtime, checked against PyTorch.

    Example: planformer export runs/small/checkpoint.pt office.onnx
    """
    importlib.import_module("planformer.models")  # says how to install PyTorch where it lacks
    from planformer.export import export_checkpoint

    made = export_checkpoint(checkpoint, output, name=name)
    if as_json:
        print_json(
            {
                "weights": str(made.weights),
                "card": str(made.card),
                "difference": made.difference,
            }
        )
        return
    print_facts(
        "weights exported",
        {
            "weights": str(made.weights),
            "card": str(made.card),
            "difference": f"at most {made.difference:.1e} from PyTorch",
        },
    )
