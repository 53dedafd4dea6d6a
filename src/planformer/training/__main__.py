"""``python -m planformer.training``: train a preset on a data set."""

from __future__ import annotations

import argparse
import sys
from dataclasses import fields, replace
from pathlib import Path

from planformer.encoding import QueryKind
from planformer.errors import PlanformerError
from planformer.models import PRESETS, MPTConfig, preset
from planformer.training.config import TrainConfig, config_for
from planformer.training.devices import is_first_process
from planformer.training.sources import open_paths
from planformer.training.train import Progress, train

_REPORT_EVERY = 20


def main() -> int:
    """Run a training from the command line; returns the exit status."""
    options = _parser().parse_args()
    try:
        network = _network(options)
        result = train(
            network,
            _config(options, network),
            open_paths(options.data / "train"),
            options.output,
            validation=open_paths(options.data / "val"),
            report=_print,
        )
    except PlanformerError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    if not is_first_process():
        return 0
    outcome = "finished" if result.finished else "interrupted; the same command resumes it"
    print(f"{result.checkpoint}: {result.step} steps, {outcome}")
    return 0 if result.finished else 130


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m planformer.training", description=__doc__)
    parser.add_argument("--preset", choices=list(PRESETS), default="small")
    parser.add_argument("--query", choices=[kind.value for kind in QueryKind])
    parser.add_argument("--data", type=Path, required=True, help="folder with train/ and val/")
    parser.add_argument("--output", type=Path, required=True, help="folder of the training")
    parser.add_argument("--minutes", type=float, help="end after this training time")
    parser.add_argument("--steps", type=int, help="end after this many steps")
    for name, kind in (
        ("batch-size", int),
        ("learning-rate", float),
        ("positive-weight", float),
        ("warmup-steps", int),
        ("seed", int),
        ("workers", int),
        ("threads", int),
        ("device", str),
        ("devices", int),
        ("initial", str),
        ("teacher", str),
        ("validate-every", int),
        ("validation-problems", int),
    ):
        parser.add_argument(f"--{name}", type=kind)
    return parser


def _network(options: argparse.Namespace) -> MPTConfig:
    network = preset(options.preset)
    return replace(network, query=options.query) if options.query else network


def _config(options: argparse.Namespace, network: MPTConfig) -> TrainConfig:
    names = {field.name for field in fields(TrainConfig)}
    given = {key: value for key, value in vars(options).items() if key in names}
    seconds = None if options.minutes is None else 60 * options.minutes
    return config_for(network, **{**given, "seconds": seconds})


def _print(progress: Progress) -> None:
    if progress.step % _REPORT_EVERY == 0:
        print(
            f"{progress.seconds:7.0f} s  step {progress.step}  loss {progress.loss:.4f}  "
            f"lr {progress.learning_rate:.2e}",
            flush=True,
        )
    for kind, metrics in (progress.metrics or {}).items():
        values = "  ".join(f"{name} {value:.4g}" for name, value in metrics.items())
        print(f"  {kind:8} {values}", flush=True)


if __name__ == "__main__":
    sys.exit(main())
