"""The command line's entry point: its commands, and what they do when something goes wrong."""

from __future__ import annotations

from typing import Annotated, Any

import typer
from typer.core import TyperGroup

import planformer
from planformer.cli.bench import bench_app
from planformer.cli.console import give_up_stdout, report
from planformer.cli.exit_codes import BAD_INPUT, BROKEN_PIPE, INTERRUPTED
from planformer.cli.export import export_command
from planformer.cli.generate import generate_command
from planformer.cli.info import info_command
from planformer.cli.map import map_command
from planformer.cli.plan import plan_command
from planformer.cli.serve import serve_command
from planformer.cli.states import StateCommand
from planformer.cli.train import train_command
from planformer.errors import PlanformerError


class _Commands(TyperGroup):
    """Turns errors into one line and an exit code; what is not foreseen keeps its traceback."""

    def invoke(self, ctx: Any) -> Any:
        try:
            return super().invoke(ctx)
        except PlanformerError as error:
            report(str(error))
            raise typer.Exit(BAD_INPUT) from error
        except BrokenPipeError as error:
            give_up_stdout()
            raise typer.Exit(BROKEN_PIPE) from error
        except OSError as error:
            report(f"{error.filename or 'output'}: {error.strerror or error}")
            raise typer.Exit(BAD_INPUT) from error
        except KeyboardInterrupt as error:
            report("interrupted", kind="")
            raise typer.Exit(INTERRUPTED) from error


def _print_version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"planformer {planformer.__version__}")
        raise typer.Exit


app = typer.Typer(
    cls=_Commands,
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode="rich",
    context_settings={"help_option_names": ["-h", "--help"]},
)


@app.callback()
def _options(
    version: Annotated[
        bool,
        typer.Option("--version", callback=_print_version, is_eager=True, help="Show the version."),
    ] = False,
) -> None:
    """Learned guidance for sampling-based motion planning on maps."""


app.command("plan", cls=StateCommand)(plan_command)
app.command("map")(map_command)
app.command("serve")(serve_command)
app.command("info")(info_command)
app.command("generate")(generate_command)
app.command("train")(train_command)
app.command("export")(export_command)
app.add_typer(bench_app, name="bench")


def main() -> None:
    """Run the command line; the console script `planformer`."""
    app(prog_name="planformer")
