"""Generation of data sets: expert paths on generated maps, in parallel and resumable.

A data set is a folder with its settings in ``dataset.json`` (see `planformer.data.spec`) and its
paths in shards, ``forest-00000.npz`` and so on (see `planformer.data.shards` for their arrays).
Maps are stored as generator name, seed and size, never as cells.

Map number i of a kind draws from ``SeedSequence(seed, spawn_key=(crc32(kind), i))``, so what a
shard holds depends neither on the number of workers, nor on which other shards are made.
"""

from __future__ import annotations

import zlib
from collections.abc import Generator, Iterable, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import closing
from multiprocessing import get_context
from pathlib import Path

import numpy as np
from rich.progress import Progress

from planformer.data.experts import shortest_path
from planformer.data.problems import draw_problems
from planformer.data.recipe import MapRecipe, checksum
from planformer.data.shards import MapPaths, Shard, write_shard
from planformer.data.spec import MANIFEST, DatasetSpec, read_spec, write_spec
from planformer.errors import InvalidDataset, InvalidParameter
from planformer.processes import interrupts_left_to_parent

_MapJob = tuple[DatasetSpec, str, int]


def generate_dataset(
    folder: str | Path,
    *,
    kinds: Sequence[str] = ("forest", "maze"),
    maps: int,
    paths_per_map: int = 25,
    seed: int = 0,
    robot_radius: float = 0.1,
    min_distance: float = 3.0,
    maps_per_shard: int = 50,
    workers: int = 2,
    show_progress: bool = True,
) -> DatasetSpec:
    """Generate a data set of expert paths, or complete one that was interrupted.

    Shards that exist are kept; the others are written whole or not at all, also when interrupted
    (Ctrl-C). The content depends on the settings alone, not on the number of workers. Maps are
    24 m x 24 m at 0.05 m. With more than one worker, a script that calls this needs the usual
    ``if __name__ == "__main__":`` of multiprocessing.

    Args:
        folder: The data set's folder; created where it does not exist.
        kinds: Kinds of maps, names in `planformer.data.recipe.GENERATORS`.
        maps: Number of maps of each kind.
        paths_per_map: Number of problems on each map.
        seed: Seed of the data set, >= 0.
        robot_radius: Radius of the robot in metres.
        min_distance: Least straight-line distance from start to goal in metres.
        maps_per_shard: Number of maps in a file.
        workers: Number of processes; 1 works in this one.
        show_progress: Whether to show a progress bar.

    Returns:
        The data set's settings.

    Raises:
        InvalidParameter: A value is out of range.
        InvalidDataset: The folder holds a data set with other settings, or something else.
    """
    if workers < 1:
        raise InvalidParameter(f"workers must be >= 1; got {workers}")
    spec = DatasetSpec(
        kinds=tuple(kinds),
        maps=maps,
        paths_per_map=paths_per_map,
        seed=seed,
        robot_radius=robot_radius,
        min_distance=min_distance,
        maps_per_shard=maps_per_shard,
    )
    _claim(Path(folder), spec)
    _complete(Path(folder), spec, workers=workers, show_progress=show_progress)
    return spec


def _claim(folder: Path, spec: DatasetSpec) -> None:
    """Make the folder this data set's, or check that it is."""
    if folder.exists() and not folder.is_dir():
        raise InvalidDataset(f"{folder} is a file; choose another folder")
    folder.mkdir(parents=True, exist_ok=True)
    if (folder / MANIFEST).exists():
        found = read_spec(folder)
        if found != spec:
            raise InvalidDataset(
                f"{folder} holds a data set with other settings: {found}; to complete it, ask "
                f"for these, and for {spec} choose another folder"
            )
    elif any(folder.iterdir()):
        raise InvalidDataset(f"{folder} is neither empty nor a data set; choose another folder")
    else:
        write_spec(folder, spec)


def _complete(folder: Path, spec: DatasetSpec, *, workers: int, show_progress: bool) -> None:
    """Make the shards that the folder lacks."""
    missing = {name: at for name, at in spec.shards().items() if not (folder / name).exists()}
    jobs = [(spec, kind, index) for kind, indices in missing.values() for index in indices]
    with Progress(disable=not show_progress) as progress, closing(_solve(jobs, workers)) as solved:
        task = progress.add_task("Generating maps", total=len(jobs))
        for name, (_, indices) in missing.items():
            maps = []
            for _ in indices:
                maps.append(next(solved))
                progress.advance(task)
            write_shard(folder / name, Shard.from_maps(maps, spec.robot_radius))


def _solve(jobs: Iterable[_MapJob], workers: int) -> Generator[MapPaths, None, None]:
    """Solve the maps in order."""
    if workers == 1:
        yield from map(_solve_map, jobs)
        return
    with interrupts_left_to_parent():
        pool = ProcessPoolExecutor(workers, mp_context=get_context("spawn"))
        solved = pool.map(_solve_map, jobs)  # starts the workers
    try:
        yield from solved
    finally:
        pool.shutdown(cancel_futures=True)


def _solve_map(job: _MapJob) -> MapPaths:
    """Make a map, draw its problems and solve them."""
    spec, kind, index = job
    seeds = np.random.SeedSequence(spec.seed, spawn_key=(zlib.crc32(kind.encode()), index))
    map_seed, problem_seed = (int(s) for s in seeds.generate_state(2, np.uint64))
    recipe = MapRecipe(kind, map_seed, spec.size, spec.size, spec.resolution)
    grid = recipe.generate()
    starts, goals = draw_problems(
        grid,
        spec.robot_radius,
        spec.paths_per_map,
        min_distance=spec.min_distance,
        rng=np.random.default_rng(problem_seed),
    )
    paths = []
    for start, goal in zip(starts, goals, strict=True):
        path = shortest_path(grid, spec.robot_radius, start, goal)
        assert path is not None  # start and goal lie in one component
        paths.append(path)
    return MapPaths(recipe, checksum(grid.occupied), paths)
