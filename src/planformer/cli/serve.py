"""`planformer serve`: the page and the HTTP API."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from planformer.cli.console import stdout

_MEBIBYTE = 2**20


def serve_command(
    host: Annotated[
        str, typer.Option(help="Address to listen on; 0.0.0.0 lets other machines in.")
    ] = "127.0.0.1",
    port: Annotated[int, typer.Option(min=0, max=65535, help="Port; 0 takes a free one.")] = 8000,
    maps: Annotated[
        Path | None,
        typer.Option(
            metavar="FOLDER",
            help="Offer the maps of this folder and keep uploads there. Default: in memory.",
        ),
    ] = None,
    plans: Annotated[
        int | None, typer.Option(min=1, help="Searches at once. Default: one a core.")
    ] = None,
    max_seconds: Annotated[
        float, typer.Option(help="Longest search that may be asked for, in seconds.")
    ] = 10.0,
    max_upload: Annotated[int, typer.Option(min=1, help="Largest upload in MiB.")] = 16,
    max_cells: Annotated[int, typer.Option(min=1, help="Most cells of a map.")] = 4_000_000,
    open_page: Annotated[bool, typer.Option("--open", help="Open the page in a browser.")] = False,
) -> None:
    """Serve the playground page and the HTTP API, until Ctrl-C.

    There is no login: whoever reaches the address can plan and upload maps.

    Example: planformer serve --maps ~/maps --open
    """
    from planformer.serve import ServeSettings, serve
    from planformer.serve.settings import LOOPBACK

    defaults = ServeSettings()
    settings = ServeSettings(
        folder=maps,
        hosts=LOOPBACK if host in LOOPBACK else None,
        plans=plans or defaults.plans,
        plan_seconds=max_seconds,
        upload_bytes=max_upload * _MEBIBYTE,
        map_cells=max_cells,
        cells_in_memory=max(defaults.cells_in_memory, max_cells),
    )

    def announce(url: str) -> None:
        stdout.print(f"planformer is at {url}, its API at {url}/docs; Ctrl-C ends it")
        if open_page:
            typer.launch(url)

    serve(settings, host=host, port=port, on_start=announce)
