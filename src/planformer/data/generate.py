"""Generation of data sets: expert paths on maps, in parallel and resumable.

A data set is a folder with its settings in ``dataset.json`` (see `planformer.data.spec`) and its
maps and paths in shards, ``forest-00000.parquet`` and so on (see `planformer.data.shards`).

What a shard holds depends neither on the number of workers, nor on which other shards are made: map
number i of a kind has seeds of its own (`planformer.data.recipe.map_seeds`).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import closing
from itertools import islice
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from rich.console import Console
from rich.progress import MofNCompleteColumn, Progress

from planformer.data.arcs import arc_ends, driven_poses
from planformer.data.folder import claimed, writing
from planformer.data.parallel import solved_in_order
from planformer.data.problems import random_problems
from planformer.data.recipe import (
    USER_KIND,
    AnyMap,
    MapRecipe,
    StoredMap,
    checksum,
    map_seeds,
)
from planformer.data.settings import make_expert, settled
from planformer.data.shards import MapPaths, Shard, write_shard
from planformer.data.spec import DatasetSpec
from planformer.errors import InvalidParameter
from planformer.planning import Problem, path_is_valid

_DRAWS_A_PATH = 20
"""Problems drawn for each path at most; an expert that solves fewer does not fit the maps."""
_LARGEST_SEED = 2**31


class _MapJob(NamedTuple):
    """What a worker needs to know of a map; `own` is given for a user's."""

    spec: DatasetSpec
    kind: str
    number: int
    own: StoredMap | None


def generate_dataset(
    folder: str | Path,
    *,
    preset: str | None = None,
    maps_from: str | Path | None = None,
    workers: int = 2,
    ray_address: str | None = None,
    show_progress: bool = True,
    **settings: Any,
) -> DatasetSpec:
    """Generate a data set of expert paths, or complete one that was interrupted.

    Shards that exist are kept; the others are written whole or not at all, also when interrupted
    or killed. The content depends on the settings alone, not on the number of workers or where
    they run, unless the expert has a time limit. With more than one worker, a script that calls
    this needs the usual ``if __name__ == "__main__":`` of multiprocessing.

    Args:
        folder: The data set's folder; created where it does not exist.
        preset: A name in `planformer.data.settings.PRESETS`.
        maps_from: Folder of your own maps; every file in it that `load_map` reads is used.
        workers: Number of processes; 1 works in this one.
        ray_address: Ray cluster to work on instead, see `planformer.data.parallel`.
        show_progress: Whether to show a progress bar.
        **settings: Attributes of `planformer.data.spec.DatasetSpec` but for `user_maps`. Without
            a preset, `maps` is needed for generated maps; by default these are forests and mazes,
            none beside maps of your own. Robot, distances and expert have the paper's values.

    Returns:
        The data set's settings.

    Raises:
        InvalidParameter: A value is out of range, or the expert solves hardly any problem.
        InvalidRobot: A dimension of the robot is out of range.
        InvalidMap: One of your own maps cannot be read, or the robot has no room on it.
        InvalidDataset: The folder holds a data set with other settings, or something else, or
            cannot be written.
        MissingExtra: Ray is asked for and not installed.
    """
    if workers < 1:
        raise InvalidParameter(f"workers must be >= 1; got {workers}")
    folder, own_folder = Path(folder), None if maps_from is None else Path(maps_from)
    spec, own = settled(settings, preset=preset, maps_from=own_folder)
    make_expert(spec)  # an unknown name ends it here
    with claimed(folder, spec) as missing:
        jobs = list(_jobs(spec, own, missing))
        solved = solved_in_order(_solve_map, jobs, workers=workers, ray_address=ray_address)
        with closing(solved), _progress_bar(show_progress) as progress:
            _fill(folder, spec, missing, _shown(solved, progress, len(jobs)))
    return spec


def _fill(folder: Path, spec: DatasetSpec, shards: Sequence[str], maps: Iterable[MapPaths]) -> None:
    """Write shards from their maps."""
    contents, solved = spec.shards(), iter(maps)
    for name in shards:
        shard = Shard.from_maps(list(islice(solved, len(contents[name][1]))), spec.make_robot())
        with writing(folder / name):
            write_shard(folder / name, shard)


def _progress_bar(shown: bool) -> Progress:
    columns = (*Progress.get_default_columns(), MofNCompleteColumn())
    return Progress(*columns, disable=not shown, console=Console(stderr=True))


def _shown(maps: Iterable[MapPaths], progress: Progress, total: int) -> Iterator[MapPaths]:
    """The maps, each counted as it comes."""
    task = progress.add_task("Generating maps", total=total)
    for of_map in maps:
        progress.advance(task)
        yield of_map


def _jobs(spec: DatasetSpec, own: Sequence[StoredMap], shards: Sequence[str]) -> Iterator[_MapJob]:
    contents = spec.shards()
    for kind, indices in (contents[name] for name in shards):
        for index in indices:
            yield _MapJob(spec, kind, index, own[index] if kind == USER_KIND else None)


def _solve_map(job: _MapJob) -> MapPaths:
    """Make a map, draw its problems and solve them."""
    spec, kind, number, own = job
    map_seed, problem_seed, expert_seed = map_seeds(spec.seed, kind, number)
    recipe = own or MapRecipe(kind, map_seed, spec.width, spec.height, spec.resolution)
    try:
        return _paths_on(recipe, spec, problem_seed, expert_seed)
    except InvalidParameter as error:
        name = f"your map {own.name}" if own else f"{kind} number {number}"
        raise InvalidParameter(f"{name}: {error}") from error


def _paths_on(recipe: AnyMap, spec: DatasetSpec, problem_seed: int, expert_seed: int) -> MapPaths:
    grid, robot = recipe.grid(), spec.make_robot()
    expert = make_expert(spec)
    seeds = np.random.default_rng(expert_seed)
    problems = random_problems(
        grid,
        robot,
        min_distance=spec.min_distance,
        max_distance=spec.max_distance,
        rng=np.random.default_rng(problem_seed),
    )
    paths: list[NDArray[np.float64]] = []
    for drawn, problem in enumerate(islice(problems, _DRAWS_A_PATH * spec.paths_per_map), 1):
        path = expert.solve(problem, int(seeds.integers(_LARGEST_SEED)))
        stored = None if path is None else _stored(path, problem)
        if stored is not None:
            paths.append(stored)
        if len(paths) == spec.paths_per_map:
            return MapPaths(recipe, checksum(grid.occupied), paths, drawn - len(paths))
    raise InvalidParameter(
        f"the expert {spec.expert} solved {len(paths)} of "
        f"{_DRAWS_A_PATH * spec.paths_per_map} problems, too few for "
        f"{spec.paths_per_map} paths; choose another expert, a smaller robot or other distances"
    )


def _stored(path: NDArray[np.float64], problem: Problem) -> NDArray[np.float64] | None:
    """What is kept of an expert's path; None where no valid path comes of it again."""
    grid, robot = problem.grid, problem.robot
    if robot.state_dimension == 2:
        return path if path_is_valid(grid, robot, path) else None
    for kept in (arc_ends(path), path):
        if path_is_valid(grid, robot, driven_poses(kept, 0.5 * grid.resolution)):
            return kept
    return None
