"""`planformer train`: train a region proposal network."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from planformer.cli.console import print_facts, print_json, stderr
from planformer.cli.exit_codes import INTERRUPTED
from planformer.cli.train_baseline import BASELINES, require_none, train_baseline

if TYPE_CHECKING:
    from planformer.training import Progress, TrainConfig, TrainResult
    from planformer.training.sources import PathSource


def train_command(
    data: Annotated[
        Path, typer.Argument(metavar="DATA", help="Folder with the data sets train/ and val/.")
    ],
    output: Annotated[Path, typer.Argument(metavar="FOLDER", help="Folder of the training.")],
    preset: Annotated[
        str,
        typer.Option(
            help="Network: small, tiny, dubins, paper, paper-small, unet or unet-small; the paper's"
            " with -fixed-encoding as well; mpnet or next-ks, planners of their own."
        ),
    ] = "small",
    recipe: Annotated[
        str | None,
        typer.Option(help="Loss and optimiser: paper or compact. Default: the preset's."),
    ] = None,
    steps: Annotated[int | None, typer.Option(help="End after this many steps.")] = None,
    minutes: Annotated[float | None, typer.Option(help="End after this training time.")] = None,
    batch_size: Annotated[int | None, typer.Option(help="Problems a step.")] = None,
    learning_rate: Annotated[
        float | None, typer.Option(help="Peak learning rate of the compact recipe.")
    ] = None,
    positive_weight: Annotated[
        float | None,
        typer.Option(help="Weight of the anchors near the path, in the compact recipe."),
    ] = None,
    validate_every: Annotated[int | None, typer.Option(help="Steps between validations.")] = None,
    seed: Annotated[int | None, typer.Option(help="Seed of weights and order.")] = None,
    workers: Annotated[int | None, typer.Option(help="Processes that load problems.")] = None,
    threads: Annotated[int | None, typer.Option(help="Threads of PyTorch on the CPU.")] = None,
    device: Annotated[str | None, typer.Option(help="PyTorch device, such as cuda.")] = None,
    devices: Annotated[int | None, typer.Option(help="Number of devices to train on.")] = None,
    initial: Annotated[
        Path | None, typer.Option(help="Checkpoint whose weights a new training starts from.")
    ] = None,
    teacher: Annotated[
        Path | None, typer.Option(help="Checkpoint of a larger network to imitate.")
    ] = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print the outcome as JSON and nothing else.")
    ] = False,
) -> None:
    """Train a network; Ctrl-C stops after a step, the same command goes on.

    The folder receives checkpoint.pt, log.csv and, for a region proposal network, curve.png.

    Example: planformer train data runs/small --minutes 60
    """
    from planformer.models import preset as network_preset
    from planformer.training import config_for, is_first_process, open_paths, train

    stderr.quiet = not is_first_process()
    given = {
        "steps": steps,
        "seconds": None if minutes is None else 60.0 * minutes,
        "learning_rate": learning_rate,
        "validate_every": validate_every,
        "seed": seed,
        "threads": threads,
        "device": device,
    }
    more = {
        "recipe": recipe,
        "batch_size": batch_size,
        "positive_weight": positive_weight,
        "workers": workers,
        "devices": devices,
        "initial": None if initial is None else str(initial),
        "teacher": None if teacher is None else str(teacher),
    }
    problems, validation = open_paths(data / "train"), open_paths(data / "val")
    _warn_of_shared_maps(problems, validation)
    if preset in BASELINES:
        require_none(preset, more)
        train_baseline(preset, problems, validation, output, given, as_json=as_json)
        return
    network = network_preset(preset)
    config = config_for(network, **given, **more)
    with _progress_bar(config, output) as show:
        result = train(network, config, problems, output, validation=validation, report=show)
    if not is_first_process():
        return
    _print_outcome(result, as_json=as_json)
    if not result.finished:
        raise typer.Exit(INTERRUPTED)


def _warn_of_shared_maps(problems: PathSource, validation: PathSource) -> None:
    own = set(validation.recipes)
    if shared := own.intersection(problems.recipes):
        stderr.print(
            f"warning: {len(shared)} of the {len(own)} maps in val/ are in train/ too, so that the "
            "validation does not say how good the network is on new ones; `generate` val/ with "
            "another --seed",
            soft_wrap=True,
        )


@contextmanager
def _progress_bar(config: TrainConfig, folder: Path) -> Iterator[Callable[[Progress], None]]:
    """A bar on stderr towards the first limit; yields what shows the progress of each step.

    Each validation is printed as well and drawn in the folder's curve.png.
    """
    from rich import progress as bars

    columns = (bars.TextColumn("{task.description}"), bars.BarColumn(), bars.TimeElapsedColumn())
    with bars.Progress(*columns, console=stderr) as bar:
        task = bar.add_task("preparing", total=1.0)

        def show(progress: Progress) -> None:
            bar.update(task, completed=_share(progress, config), description=_line(progress))
            for kind, metrics in (progress.metrics or {}).items():
                stderr.print(f"step {progress.step}  {kind}: {_words(metrics)}", soft_wrap=True)
            if progress.metrics:
                _draw_curve(folder)

        yield show


def _draw_curve(folder: Path) -> None:
    from planformer.plotting import plot_training, save_picture

    save_picture(plot_training(folder / "log.csv"), folder / "curve.png")


def _share(progress: Progress, config: TrainConfig) -> float:
    """How much of the training is done, 0 to 1."""
    by_steps = progress.step / config.steps if config.steps else 0.0
    by_time = progress.seconds / config.seconds if config.seconds else 0.0
    return max(by_steps, by_time)


def _line(progress: Progress) -> str:
    return f"step {progress.step}  loss {progress.loss:.4f}"


def _words(metrics: Mapping[str, float]) -> str:
    return "  ".join(f"{name} {value:.4g}" for name, value in metrics.items())


def _print_outcome(result: TrainResult, *, as_json: bool) -> None:
    if as_json:
        print_json({**asdict(result), "checkpoint": str(result.checkpoint)})
        return
    title = "training finished" if result.finished else "interrupted; the same command goes on"
    facts = {"checkpoint": str(result.checkpoint), "steps": f"{result.step:,}"}
    print_facts(title, facts | {kind: _words(values) for kind, values in result.metrics.items()})
