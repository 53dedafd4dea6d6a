"""Generations that end early: Ctrl-C, kill -9, a full disk, a second process."""

from __future__ import annotations

import fcntl
import os
import signal
import subprocess
import sys
import time
from contextlib import suppress

import pytest

from planformer.data.dataset import PathDataset
from planformer.data.generate import generate_dataset
from planformer.data.shards import read_shard
from planformer.errors import InvalidDataset

SETTINGS = {
    "maps": 20,
    "paths_per_map": 2,
    "seed": 1,
    "width": 9.0,
    "height": 9.0,
    "maps_per_shard": 2,
}
SCRIPT = """
import resource, sys
from planformer.data.generate import generate_dataset
from planformer.errors import InvalidDataset
if __name__ == "__main__":
    {before}
    generate_dataset({folder!r}, workers={workers}, show_progress=False, **{settings!r})
"""
HOLD_WRITES = (
    "from planformer import files; files.os.fsync = lambda _: __import__('time').sleep(60)"
)


def start(tmp_path, *, workers, before="pass", settings=SETTINGS):
    script = tmp_path / "script.py"
    folder = str(tmp_path / "set")
    script.write_text(
        SCRIPT.format(folder=folder, workers=workers, before=before, settings=settings)
    )
    return subprocess.Popen(
        [sys.executable, script], start_new_session=True, stderr=subprocess.PIPE, text=True
    )


def wait_for(folder, pattern, process):
    while not list(folder.glob(pattern)):
        assert process.poll() is None, process.stderr.read()
        time.sleep(0.005)


def assert_whole_shards_alone(folder, *, spare=()):
    names = {file.name for file in folder.iterdir()} - set(spare)
    assert names < {"dataset.json", *(f"forest-{i:05d}.parquet" for i in range(200))} | {
        f"maze-{i:05d}.parquet" for i in range(200)
    }
    for name in names - {"dataset.json"}:
        assert len(read_shard(folder / name).recipes) == 2
    with pytest.raises(InvalidDataset, match="lacks"):
        PathDataset(folder)


@pytest.fixture(scope="module")
def uninterrupted(tmp_path_factory):
    folder = tmp_path_factory.mktemp("whole") / "set"
    generate_dataset(folder, workers=1, show_progress=False, **SETTINGS)
    return {file.name: file.read_bytes() for file in folder.iterdir()}


def assert_completed(folder, uninterrupted):
    """A second run keeps what there is, adds the rest and leaves nothing else behind."""
    before = {file.name: file.stat().st_mtime_ns for file in folder.glob("[fm]*.parquet")}
    generate_dataset(folder, workers=1, show_progress=False, **SETTINGS)
    assert {file.name: file.read_bytes() for file in folder.iterdir()} == uninterrupted
    for name, written in before.items():
        assert (folder / name).stat().st_mtime_ns == written


@pytest.mark.parametrize("workers", [1, 2])
def test_ctrl_c_leaves_whole_shards_and_no_traceback_of_workers(tmp_path, workers):
    process = start(tmp_path, workers=workers, settings={**SETTINGS, "maps": 400})
    wait_for(tmp_path / "set", "*.parquet", process)
    os.killpg(process.pid, signal.SIGINT)
    _, errors = process.communicate(timeout=60)
    assert process.returncode != 0
    assert errors.count("Traceback") == 1
    assert_whole_shards_alone(tmp_path / "set")


@pytest.mark.parametrize("workers", [1, 2])
@pytest.mark.parametrize("shards", [0, 1, 4])
def test_a_killed_generation_can_be_completed(tmp_path, uninterrupted, workers, shards):
    process = start(tmp_path, workers=workers)
    wait_for(tmp_path / "set", f"forest-{shards - 1:05d}.parquet" if shards else "*", process)
    process.kill()
    process.communicate(timeout=60)
    assert_completed(tmp_path / "set", uninterrupted)


@pytest.mark.parametrize("name", ["dataset.json", "forest-00000.parquet"])
def test_a_file_half_written_when_killed_does_not_count(tmp_path, uninterrupted, name):
    hold = HOLD_WRITES if name == "dataset.json" else f"_ = 0\n    {LET_FIRST_WRITE}"
    process = start(tmp_path, workers=1, before=hold)
    wait_for(tmp_path / "set", f".{name}.*.tmp", process)
    process.kill()
    process.communicate(timeout=60)
    (leftover,) = (tmp_path / "set").glob(".*.tmp")
    leftover.write_bytes(leftover.read_bytes()[:100])
    assert not (tmp_path / "set" / name).exists()
    assert_completed(tmp_path / "set", uninterrupted)


LET_FIRST_WRITE = (
    "from planformer import files\n"
    "    files.os.fsync = lambda _, calls=[]: "
    "__import__('time').sleep(60) if calls else calls.append(1)"
)


def test_workers_end_with_a_killed_parent(tmp_path):
    process = start(tmp_path, workers=2, settings={**SETTINGS, "maps": 400})
    wait_for(tmp_path / "set", "*.parquet", process)
    process.kill()
    try:
        process.communicate(timeout=60)  # returns when the last worker has closed its stderr
    finally:
        with suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)


def test_a_full_disk_is_an_error_that_names_the_file_and_keeps_the_rest(tmp_path, uninterrupted):
    # Files may grow to 2 kB: enough for the settings, too little for a shard.
    limit = "resource.setrlimit(resource.RLIMIT_FSIZE, (2048, 2048))"
    done = start(tmp_path, workers=1, before=limit)
    _, errors = done.communicate(timeout=60)
    assert done.returncode == 1
    last = errors.strip().splitlines()[-1]
    assert "InvalidDataset" in last
    assert "forest-00000.parquet cannot be written: File too large" in last
    assert [file.name for file in (tmp_path / "set").iterdir()] == ["dataset.json"]
    assert_completed(tmp_path / "set", uninterrupted)


def test_a_second_process_is_kept_out(tmp_path, uninterrupted):
    (tmp_path / "set").mkdir()
    descriptor = os.open(tmp_path / "set", os.O_RDONLY)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX)
        with pytest.raises(InvalidDataset, match="another process is generating"):
            generate_dataset(tmp_path / "set", workers=1, show_progress=False, **SETTINGS)
    finally:
        os.close(descriptor)
    assert_completed(tmp_path / "set", uninterrupted)
