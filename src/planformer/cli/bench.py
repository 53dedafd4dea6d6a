"""`planformer bench`: measure guides and planners; one benchmark a subcommand."""

from __future__ import annotations

import importlib
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Any

import typer

from planformer.cli.console import print_json, stderr, stdout

bench_app = typer.Typer(no_args_is_help=True, help="Measure guides and planners.")


@bench_app.command("accuracy")
def accuracy_command(
    problems: Annotated[int, typer.Option(help="Problems in each row.")],
    rows: Annotated[
        str | None,
        typer.Option(help="Rows, separated by commas: kinds and sizes of maps. Default: all."),
    ] = None,
    guide: Annotated[
        list[str] | None,
        typer.Option(
            help="Shipped weights, the path of an .onnx file, 'ideal', 'wavefront' or "
            "'lazy-theta'; can be repeated. Default: mpt and ideal."
        ),
    ] = None,
    output: Annotated[Path, typer.Option(metavar="FOLDER", help="Folder of the results.")] = Path(
        "bench_accuracy"
    ),
    real_maps: Annotated[
        Path | None,
        typer.Option(metavar="FOLDER", help="Folder with the real maps; adds their rows."),
    ] = None,
    workers: Annotated[
        int, typer.Option(help="Number of processes; several make times those of a busy machine.")
    ] = 1,
    limit: Annotated[
        float | None,
        typer.Option(help="Seconds of a search. Default: 10 for a point robot, 2 for a car."),
    ] = None,
    max_vertices: Annotated[
        int | None, typer.Option(help="End a search at this many vertices as well.")
    ] = None,
    seed: Annotated[int, typer.Option(help="Seed of the problems.")] = 0,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print the summary as JSON and nothing else.")
    ] = False,
) -> None:
    """Measure how often RRT* finds good paths in the proposed regions alone.

    Ctrl-C keeps what is measured; the same command goes on.

    Example: planformer bench accuracy --problems 5 --rows forest-480,maze-480
    """
    from planformer.bench import AccuracySettings, run_accuracy
    from planformer.bench.rows import chosen_rows

    names = None if rows is None else [name.strip() for name in rows.split(",")]
    guides = {"guides": tuple(guide)} if guide else {}
    with _progress_bar() as show:
        summary = run_accuracy(
            output,
            chosen_rows(names, real_maps),
            problems=problems,
            settings=AccuracySettings(
                seed=seed, seconds=limit, max_vertices=max_vertices, **guides
            ),
            workers=workers,
            report=show,
        )
    if as_json:
        print_json(summary)
    else:
        _print_table(summary, output)


@contextmanager
def _progress_bar() -> Iterator[Callable[[int, int], None]]:
    """A bar on stderr; yields what shows the progress."""
    from rich import progress as bars

    columns = (
        bars.TextColumn("{task.completed} of {task.total} problems"),
        bars.BarColumn(),
        bars.TimeElapsedColumn(),
        bars.TimeRemainingColumn(elapsed_when_finished=True),
    )
    with bars.Progress(*columns, console=stderr) as bar:
        task = bar.add_task("problems", total=None)
        yield lambda done, total: bar.update(task, completed=done, total=total)


def _print_table(summary: dict[str, Any], output: Path) -> None:
    from rich.table import Column, Table

    from planformer.bench.accuracy.report import COLUMNS, SHORT, table_cells

    columns = {name: COLUMNS[name] for name in SHORT}
    names = [Column(name, no_wrap=True) for name in ("maps", "guide", "threshold")]
    numbers = [Column(name.replace(" ", "\n", 1), justify="right") for name in ("N", *columns)]
    table = Table(*names, *numbers, box=None, padding=(0, 2, 0, 0), pad_edge=False)
    for line in summary["lines"]:
        table.add_row(*table_cells(line, columns, intervals=False))
    stdout.print(table)
    stdout.print(f"{output}: summary.json, table.md, problems.csv.gz", soft_wrap=True)


_TABLES = {
    "table1": "Planners of a point robot in forests of 480 x 480 pixels: the paper's table I.",
    "table2": "Planners of a point robot in mazes of 480 x 480 pixels: the paper's table II.",
    "table3": "Planners of a point robot in forests of four sizes: the paper's table III.",
    "table4": "Planners of a Dubins car in forests of 480 x 480 pixels: the paper's table IV.",
    "table5": "Planners of a point robot on real maps, and on MovingAI scenarios.",
}


def _table_command(tables: Sequence[str]) -> Callable[..., None]:
    """The command that measures some tables, one after the other."""

    def command(
        problems: Annotated[int, typer.Option(help="Problems in each row.")],
        output: Annotated[
            Path, typer.Option(metavar="FOLDER", help="Each table has a folder in it.")
        ] = Path("bench_tables"),
        systems: Annotated[
            str | None, typer.Option(help="Systems, separated by commas. Default: all.")
        ] = None,
        slack: Annotated[
            float, typer.Option(help="A path this many times as long as the reference solves.")
        ] = 1.01,
        limit: Annotated[float, typer.Option(help="Seconds of a search.")] = 5.0,
        reference: Annotated[
            str, typer.Option(help="'best', the best path known, or 'rrtstar' as in the paper.")
        ] = "best",
        reference_seconds: Annotated[
            float, typer.Option(help="Seconds for RRT* where its path is the reference.")
        ] = 90.0,
        real_maps: Annotated[
            Path | None, typer.Option(metavar="FOLDER", help="The real maps of table5.")
        ] = None,
        workers: Annotated[
            int | None,
            typer.Option(
                help="Number of processes. Default: one a core, so that times are those of a busy "
                "machine, for all systems alike."
            ),
        ] = None,
        seed: Annotated[int, typer.Option(help="Seed of the problems.")] = 0,
        as_json: Annotated[
            bool, typer.Option("--json", help="Print the summaries as JSON and nothing else.")
        ] = False,
    ) -> None:
        from planformer.bench.tables import TableSettings, run_table, table_rows
        from planformer.processes import cores

        settings = TableSettings(
            slack=slack,
            seconds=limit,
            reference=reference,
            reference_seconds=reference_seconds,
            seed=seed,
            systems=None if systems is None else tuple(name.strip() for name in systems.split(",")),
        )
        summaries = {}
        for table in tables:
            if table == "table5" and real_maps is None and len(tables) > 1:
                stderr.print("table5 is left out: it needs --real-maps", soft_wrap=True)
                continue
            maps = real_maps if table == "table5" else None
            if len(tables) > 1 and not any(map(settings.systems_of, table_rows(table, maps))):
                stderr.print(f"{table} is left out: it has none of the systems", soft_wrap=True)
                continue
            with _progress_bar() as show:
                summaries[table] = run_table(
                    output / table,
                    table,
                    problems=problems,
                    settings=settings,
                    real_maps=maps,
                    workers=cores() if workers is None else workers,
                    report=show,
                )
            if not as_json:
                _print_systems(summaries[table], output / table)
        if as_json:
            print_json(summaries)

    return command


for _name, _help in _TABLES.items():
    bench_app.command(_name, help=f"{_help} Ctrl-C keeps what is measured.")(
        _table_command([_name])
    )
bench_app.command("all", help="All tables. Ctrl-C keeps what is measured.")(
    _table_command(list(_TABLES))
)


def _measurement_command(name: str, default: int) -> Callable[..., None]:
    """The command of the module planformer.bench.NAME, which has run_NAME and markdown."""

    def command(
        problems: Annotated[int, typer.Option(help="Problems in each row.")] = default,
        output: Annotated[
            Path, typer.Option(metavar="FOLDER", help="Folder of the results.")
        ] = Path(f"bench_{name}"),
        seed: Annotated[int, typer.Option(help="Seed of maps and problems.")] = 0,
        as_json: Annotated[
            bool, typer.Option("--json", help="Print the summary as JSON and nothing else.")
        ] = False,
    ) -> None:
        module = importlib.import_module(f"planformer.bench.{name}")
        with _progress_bar() as show:
            summary = getattr(module, f"run_{name}")(
                output, problems=problems, seed=seed, report=show
            )
        if as_json:
            print_json(summary)
        else:
            stdout.print(module.markdown(summary), markup=False, soft_wrap=True)

    return command


_MEASUREMENTS = {
    "latency": (100, "Time the proposal of regions and its stages."),
    "growth": (20, "Time planners on forests of 240 to 3,840 cells a side, with a plot."),
    "deadlines": (100, "Measure by how much searches overrun their time limit."),
    "throughput": (1000, "Count proposals and plans a second, on one map and on many."),
}

for _name, (_default, _help) in _MEASUREMENTS.items():
    _example = f"Example: planformer bench {_name} --problems {_default // 5}"
    bench_app.command(_name, help=f"{_help}\n\n{_example}")(_measurement_command(_name, _default))


@bench_app.command("plot")
def plot_command(
    folders: Annotated[
        list[Path], typer.Argument(metavar="FOLDER...", help="Folders of tables' results.")
    ],
) -> None:
    """Draw the figures of measured tables again.

    For each row the distributions of time and vertices, and the shares solved by a deadline.

    Example: planformer bench plot benchmarks/results/table1
    """
    from planformer.bench.tables.figures import write_figures

    for folder in folders:
        for file in write_figures(folder):
            stdout.print(str(file), soft_wrap=True)


@bench_app.command("figures")
def figures_command(
    output: Annotated[Path, typer.Option(metavar="FOLDER", help="Folder of the pictures.")] = Path(
        "bench_figures"
    ),
    figures: Annotated[
        str | None, typer.Option(help="Figures, separated by commas. Default: all.")
    ] = None,
) -> None:
    """Plan on fixed problems and draw the plans as the paper's figures do.

    Search trees side by side, a prediction beside the truth, maps of several sizes, and a car
    with the headings of its region. The plans are noted in figures.json.

    Example: planformer bench figures --output figures
    """
    from planformer.bench.figures import write_plan_figures

    names = None if figures is None else [name.strip() for name in figures.split(",")]
    for file in write_plan_figures(output, names):
        stdout.print(str(file), soft_wrap=True)


@bench_app.command("pages")
def pages_command(
    pages: Annotated[list[Path], typer.Argument(metavar="PAGE...", help="Markdown files.")],
    results: Annotated[
        Path, typer.Option(metavar="FOLDER", help="Folder that holds table1, accuracy/point, ...")
    ] = Path("benchmarks/results"),
) -> None:
    """Put results into pages, between <!-- table1:begin --> and <!-- table1:end -->.

    Blocks are table1 to table5, accuracy-point, -corridor, -maze, -car and -real; table1-short and
    accuracy-short are shorter.

    Example: planformer bench pages README.md docs/accuracy.md docs/results.md
    """
    from planformer.bench.pages import updated_page
    from planformer.files import write_files

    texts = {page: updated_page(page, results).encode() for page in pages}
    write_files(texts)
    stdout.print(", ".join(map(str, pages)), soft_wrap=True)


def _print_systems(summary: dict[str, Any], output: Path) -> None:
    from rich.table import Column, Table

    from planformer.bench.tables.report import COLUMNS, SHORT, table_cells

    columns = {name: COLUMNS[name] for name in SHORT}
    for row in dict.fromkeys(line["row"] for line in summary["lines"]):
        numbers = [Column(name, justify="right") for name in columns]
        table = Table(Column(row, no_wrap=True), *numbers, box=None, pad_edge=False)
        for line in summary["lines"]:
            if line["row"] == row:
                table.add_row(*table_cells(line, columns, intervals=False))
        stdout.print(table)
    stdout.print(f"{output}: summary.json, table.md, problems.csv.gz, figures", soft_wrap=True)
