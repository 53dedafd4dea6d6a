from __future__ import annotations

import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

from planformer.data.dataset import PathDataset
from planformer.data.generate import generate_dataset
from planformer.data.shards import read_shard
from planformer.errors import InvalidDataset, InvalidParameter


def contents(folder):
    return {file.name: file.read_bytes() for file in folder.iterdir()}


def test_the_content_does_not_depend_on_the_number_of_workers(
    small_dataset, small_settings, tmp_path
):
    generate_dataset(tmp_path / "other", workers=2, **small_settings)
    assert contents(tmp_path / "other") == contents(small_dataset)


def test_missing_shards_are_made_again_and_the_others_kept(small_dataset, small_settings):
    before = contents(small_dataset)
    (small_dataset / "maze-00000.npz").unlink()
    kept = (small_dataset / "forest-00001.npz").stat().st_mtime_ns
    generate_dataset(small_dataset, workers=1, **small_settings)
    assert contents(small_dataset) == before
    assert (small_dataset / "forest-00001.npz").stat().st_mtime_ns == kept


def test_indoor_maps_have_problems_too(tmp_path):
    generate_dataset(
        tmp_path, kinds=["indoor"], maps=2, paths_per_map=3, workers=1, show_progress=False
    )
    dataset = PathDataset(tmp_path)
    assert len(dataset) == 6
    assert {recipe.kind for recipe in dataset.recipes} == {"indoor"}
    expected = dataset.recipes[1].generate().blocked(0.1)
    np.testing.assert_array_equal(dataset.blocked_map(1), expected)


def test_the_seed_and_the_index_decide_on_a_map(small_dataset, small_settings, tmp_path):
    more = {**small_settings, "maps": 4, "kinds": ["maze"]}
    generate_dataset(tmp_path / "more", workers=1, **more)
    generate_dataset(tmp_path / "other", workers=1, **{**more, "seed": 6})
    first = read_shard(small_dataset / "maze-00000.npz")
    same = read_shard(tmp_path / "more" / "maze-00000.npz")
    other = read_shard(tmp_path / "other" / "maze-00000.npz")
    assert same.recipes == first.recipes
    np.testing.assert_array_equal(same.vertices, first.vertices)
    seeds = [r.seed for shard in (first, other) for r in shard.recipes]
    assert len(set(seeds)) == 4


def test_other_settings_or_another_folder_are_refused(small_dataset, small_settings, tmp_path):
    before = contents(small_dataset)
    with pytest.raises(InvalidDataset, match="other settings"):
        generate_dataset(small_dataset, **{**small_settings, "seed": 6})
    assert contents(small_dataset) == before
    (tmp_path / "note.txt").write_text("mine")
    with pytest.raises(InvalidDataset, match="neither empty nor a data set"):
        generate_dataset(tmp_path, **small_settings)
    with pytest.raises(InvalidDataset, match="is a file"):
        generate_dataset(tmp_path / "note.txt", **small_settings)


def test_bad_settings_leave_nothing_behind(small_settings, tmp_path):
    for bad in ({"workers": 0}, {"maps": 0}, {"kinds": ["swamp"]}):
        with pytest.raises(InvalidParameter):
            generate_dataset(tmp_path / "set", **{**small_settings, **bad})
    assert not (tmp_path / "set").exists()


@pytest.mark.skipif(os.name != "posix", reason="sends SIGINT to a process group")
@pytest.mark.parametrize("workers", [1, 2])
def test_ctrl_c_leaves_whole_shards_that_a_second_run_completes(tmp_path, workers):
    folder = tmp_path / "set"
    settings = {"maps": 300, "paths_per_map": 2, "seed": 1, "maps_per_shard": 3}
    script = tmp_path / "script.py"
    script.write_text(
        "from planformer.data.generate import generate_dataset\n"
        "if __name__ == '__main__':\n"
        f"    generate_dataset({str(folder)!r}, workers={workers}, **{settings!r})\n"
    )
    process = subprocess.Popen(
        [sys.executable, script], start_new_session=True, stderr=subprocess.PIPE, text=True
    )
    while not list(folder.glob("*.npz")):
        assert process.poll() is None, process.stderr.read()
        time.sleep(0.01)
    os.killpg(process.pid, signal.SIGINT)
    _, errors = process.communicate(timeout=60)
    assert process.returncode != 0
    assert errors.count("Traceback") == 1  # the workers end quietly
    names = {file.name for file in folder.iterdir()}
    assert names < {"dataset.json", *(f"forest-{i:05d}.npz" for i in range(100))}
    for name in names - {"dataset.json"}:
        assert len(read_shard(folder / name).recipes) == 3
    with pytest.raises(InvalidDataset, match="lacks"):
        PathDataset(folder)
