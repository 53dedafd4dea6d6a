"""What helps a network to learn: small networks trained alike but for one thing each.

Each variant is trained for the same number of steps on maps of one size and measured at the
threshold 0.5 on unseen maps of that size and of others, whose sides have the ratios of
the paper's Table III, where its fixed and shifted position encodings differ. Run again, it goes on
where it stopped.

    python benchmarks/ablation.py --data data --steps 600 --teacher runs/small/checkpoint.pt
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
from common import save_result
from rich.console import Console
from rich.progress import track
from rich.table import Table

from planformer.bench.statistics import bootstrap_interval, share_interval
from planformer.data.generate import generate_dataset
from planformer.encoding import QueryKind
from planformer.files import write_files
from planformer.models import CompactBody, MPTConfig, load_checkpoint, preset
from planformer.training import TrainConfig, open_paths, train
from planformer.training.sources import PathSource
from planformer.training.validation import measurements

SEED = 40_000
"""Of the validation sets; training data draw theirs elsewhere."""
OTHER_SIZES = ((18, 12), (24, 12), (28, 28), (39, 39))
"""Width and height of the maps that no variant has been trained on, in 24ths of the training maps'
sides."""

TINY = preset("tiny")
BODY = TINY.body
assert isinstance(BODY, CompactBody)


@dataclass(frozen=True)
class Variant:
    """A network and what its training does differently."""

    network: MPTConfig = TINY
    changes: Mapping[str, Any] = field(default_factory=dict)


def variants(steps: int, teacher: Path | None) -> dict[str, Variant]:
    """All variants by name; the one that imitates only where there is a teacher."""
    slow = {"learning_rate": 5e-4, "warmup_steps": max(steps // 10, 1)}
    known = {
        "baseline": Variant(),
        "markers_query": Variant(replace(TINY, query=QueryKind.MARKERS)),
        "attention": Variant(replace(TINY, body=replace(BODY, heads=2))),
        "width_96": Variant(replace(TINY, body=replace(BODY, width=96))),
        "no_augmentation": Variant(changes={"augment": False}),
        "positive_weight_1": Variant(changes={"positive_weight": 1.0}),
        "positive_weight_2": Variant(changes={"positive_weight": 2.0}),
        "imitation": Variant(changes={"teacher": str(teacher)}),
        "paper_shifted_encoding": Variant(preset("paper-small"), slow),
        "paper_fixed_encoding": Variant(preset("paper-small-fixed-encoding"), slow),
    }
    return {name: v for name, v in known.items() if teacher or name != "imitation"}


def validation_sets(
    folder: Path, training: PathSource, problems: int, workers: int
) -> dict[str, PathSource]:
    """A source for each size, the trained one first, with all kinds of maps trained on."""
    kinds = sorted({recipe.kind for recipe in training.recipes})
    recipe = training.recipes[0]
    trained = recipe.width, recipe.height
    others = [(recipe.width * w / 24, recipe.height * h / 24) for w, h in OTHER_SIZES]
    sets: dict[str, PathSource] = {}
    for size in (trained, *others):
        name = "{:g}x{:g}".format(*size)
        generate_dataset(
            folder / name,
            kinds=kinds,
            maps=-(-problems // 2),
            paths_per_map=2,
            seed=SEED,
            width=size[0],
            height=size[1],
            workers=workers,
        )
        sets[name] = open_paths(folder / name)
    return sets


def measured(
    folder: Path, variant: Variant, config: TrainConfig, data: PathSource, sets: dict[str, Any]
) -> dict[str, Any]:
    """Train a variant and measure it, or read what was measured before."""
    file = folder / "measured.json"
    asked = {
        "training": config.to_dict(),
        "problems": {name: len(source) for name, source in sets.items()},
    }
    if file.exists():
        record = json.loads(file.read_text(encoding="utf-8"))
        if record["asked"] == asked:
            return record
    trained = train(variant.network, config, data, folder, validation=next(iter(sets.values())))
    if not trained.finished:
        raise typer.Exit(130)
    _, model, stored = load_checkpoint(trained.checkpoint)
    # One problem a batch, so that each has a loss of its own: the baseline's for all variants.
    judge = TrainConfig(steps=1, batch_size=1, validation_problems=10**6)
    rows: dict[str, list[list[float]]] = {}
    for name, source in sets.items():
        kinds, of_set = measurements(model, source, variant.network.scale, judge)
        for kind in np.unique(kinds):
            rows[f"{kind} {name}"] = of_set[kinds == kind].tolist()
    record = {
        "asked": asked,
        "parameters": sum(parameter.numel() for parameter in model.parameters()),
        "seconds": stored["seconds"],
        "samples_per_second": stored["step"] * config.batch_size / stored["seconds"],
        "rows": rows,
    }
    write_files({file: json.dumps(record).encode()})
    return record


def ratio(part: np.ndarray, whole: np.ndarray, axis: int) -> np.ndarray:
    """Ratio of two sums."""
    return part.sum(axis=axis) / np.maximum(whole.sum(axis=axis), 1)


def summary(rows: np.ndarray) -> dict[str, Any]:
    """Shares in percent and the mean loss, with 95 % intervals over the problems."""
    loss, selected, positive, both, connected, region = rows.T
    shares = {
        "connected": share_interval(int(connected.sum()), len(rows)),
        "region": bootstrap_interval(np.mean, region),
        "precision": bootstrap_interval(ratio, both, selected),
        "recall": bootstrap_interval(ratio, both, positive),
    }
    percent = {
        f"{name}_percent": {key: 100 * value for key, value in asdict(share).items()}
        for name, share in shares.items()
    }
    return {"problems": len(rows), **percent, "loss": asdict(bootstrap_interval(np.mean, loss))}


def pooled(records: list[dict[str, Any]]) -> dict[str, Any]:
    """The trainings of a variant with several seeds as one."""
    maps = {
        name: summary(np.concatenate([np.array(record["rows"][name]) for record in records]))
        for name in records[0]["rows"]
    }
    means = {
        name: float(np.mean([record[name] for record in records]))
        for name in ("seconds", "samples_per_second")
    }
    return {"parameters": records[0]["parameters"], **means, "maps": maps}


def print_tables(result: dict[str, Any]) -> None:
    """A table for each kind and size of maps."""
    for maps in next(iter(result.values()))["maps"]:
        columns = ("connected", "region", "precision", "recall")
        table = Table("variant", *columns, "loss", title=f"{maps}, shares in %")
        for name, of_variant in result.items():
            row = of_variant["maps"][maps]
            shares = [row[f"{column}_percent"] for column in columns]
            cells = ["{value:.1f} ({low:.1f}-{high:.1f})".format(**share) for share in shares]
            table.add_row(name, *cells, f"{row['loss']['value']:.4f}")
        Console().print(table)


def main(
    data: Annotated[Path, typer.Option(help="Folder with a data set train/, maps of one size.")],
    steps: Annotated[int, typer.Option(help="Steps of each training.")] = 600,
    seeds: Annotated[int, typer.Option(help="Trainings of each variant.")] = 1,
    problems: Annotated[int, typer.Option(help="Problems of each kind and size.")] = 200,
    teacher: Annotated[Path | None, typer.Option(help="Checkpoint to imitate.")] = None,
    only: Annotated[str | None, typer.Option(help="Names of variants, with commas.")] = None,
    batch_size: Annotated[int, typer.Option(help="Problems a step.")] = 32,
    workers: Annotated[int, typer.Option(help="Processes that prepare problems.")] = 1,
    threads: Annotated[int | None, typer.Option(help="Threads of PyTorch.")] = None,
    device: Annotated[str, typer.Option(help="PyTorch device.")] = "cpu",
    folder: Annotated[Path, typer.Option(help="Folder of the trainings.")] = Path("runs/ablation"),
    output: Annotated[Path | None, typer.Option(help="Where to write the JSON.")] = None,
) -> None:
    """Train and measure the variants one after the other."""
    chosen = variants(steps, teacher)
    if only:
        chosen = {name: chosen[name] for name in only.split(",")}
    training = open_paths(data / "train")
    sets = validation_sets(folder / "validation", training, problems, max(workers, 1))
    common = TrainConfig(
        steps=steps,
        batch_size=batch_size,
        workers=workers,
        threads=threads,
        device=device,
        validate_every=steps,
        validation_problems=1,  # `measured` does that
    )
    records: dict[str, list[dict[str, Any]]] = {name: [] for name in chosen}
    for seed in range(seeds):
        for name, variant in track(chosen.items(), f"seed {seed}"):
            config = replace(common, seed=seed, **variant.changes)
            place = folder / f"{name}-{seed}"
            records[name].append(measured(place, variant, config, training, sets))
    result = {name: pooled(of_variant) for name, of_variant in records.items()}
    print_tables(result)
    if output is not None:
        settings = {"training": common.to_dict(), "seeds": seeds, "data": asdict(training.spec)}
        save_result(output, settings, result)


if __name__ == "__main__":
    typer.run(main)
