from __future__ import annotations

import dataclasses
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

import planformer as pf
from planformer.bench import AccuracySettings, run_accuracy
from planformer.bench.accuracy.record import Record
from planformer.bench.records import from_csv
from planformer.bench.rows import MapFile, Row, Scene
from planformer.errors import InvalidParameter, InvalidResults, UnknownGuide

# Only the vertices end a search, so that the same problem always gives the same record.
SETTINGS = AccuracySettings(guides=("wavefront", "ideal"), seconds=1e3, max_vertices=500)

SCRIPT = """
import sys
import planformer as pf
from planformer.bench import AccuracySettings, run_accuracy
from planformer.bench.rows import GeneratedMaps, Row, Scene
if __name__ == "__main__":
    row = Row("small", (Scene("", GeneratedMaps("forest", 8.0, 6.0), pf.PointRobot()),))
    settings = AccuracySettings(guides=("wavefront", "ideal"), seconds=1e3, max_vertices=500)
    workers = int(sys.argv[2])
    run_accuracy(sys.argv[1], [row], problems=3000, settings=settings, workers=workers)
"""


def records(folder):
    """All records but for what the clock says."""
    found = [
        record
        for part in sorted((folder / "parts").glob("*.csv"))
        for record in from_csv(part.read_text(), Record)
    ]
    return [dataclasses.replace(r, proposal_seconds=0.0, planning_seconds=0.0) for r in found]


def run(folder, row, problems=6, settings=SETTINGS, **options):
    return run_accuracy(folder, [row], problems=problems, settings=settings, **options)


def test_a_run_leaves_its_files(small_row, tmp_path):
    seen = []
    summary = run(tmp_path / "out", small_row, report=lambda *progress: seen.append(progress))
    assert {file.name for file in (tmp_path / "out").iterdir()} == {
        "bench.json",
        "parts",
        "summary.json",
        "table.md",
        "problems.csv.gz",
    }
    assert summary == json.loads((tmp_path / "out" / "summary.json").read_text())
    assert [line["problems"] for line in summary["lines"]] == [6, 6, 6]
    assert seen == [(done, 6) for done in range(7)]


def test_the_records_do_not_depend_on_the_number_of_workers(small_row, tmp_path):
    for workers in (1, 2):
        run(tmp_path / str(workers), small_row, workers=workers)
    assert records(tmp_path / "1") == records(tmp_path / "2")


def test_what_is_measured_is_kept_when_problems_and_rows_are_added(small_row, tmp_path):
    run(tmp_path, small_row, problems=4)
    (part,) = (tmp_path / "parts").iterdir()
    before = part.stat().st_mtime_ns
    other = dataclasses.replace(small_row, name="other")
    summary = run_accuracy(tmp_path, [small_row, other], problems=6, settings=SETTINGS)
    assert part.stat().st_mtime_ns == before
    assert {(line["row"], line["problems"]) for line in summary["lines"]} == {
        ("small", 6),
        ("other", 6),
    }
    assert len(summary["sessions"]) == 2
    assert len(run(tmp_path, small_row)["sessions"]) == 2  # nothing was left to measure


@pytest.mark.parametrize(
    "other",
    [
        {"seed": 1},
        {"guides": ("wavefront",)},
        {"seconds": 10.0},
        {"max_vertices": 501},
    ],
)
def test_results_of_other_settings_are_refused(small_row, tmp_path, other):
    run(tmp_path, small_row, problems=1)
    before = records(tmp_path)
    with pytest.raises(InvalidResults, match=f"other settings: {next(iter(other))} "):
        run(tmp_path, small_row, problems=1, settings=dataclasses.replace(SETTINGS, **other))
    assert records(tmp_path) == before


def test_results_of_another_version_or_number_of_workers_are_refused(small_row, tmp_path):
    run(tmp_path, small_row, problems=1)
    with pytest.raises(InvalidResults, match="workers 1"):
        run(tmp_path, small_row, problems=1, workers=2)
    manifest = tmp_path / "bench.json"
    content = json.loads(manifest.read_text())
    content["settings"]["planformer"] = "0.0.1"
    manifest.write_text(json.dumps(content))
    with pytest.raises(InvalidResults, match=r"planformer '0\.0\.1'"):
        run(tmp_path, small_row, problems=1)
    manifest.write_text("{}")
    with pytest.raises(InvalidResults, match="damaged"):
        run(tmp_path, small_row, problems=1)


def test_other_folders_are_left_alone(small_row, tmp_path):
    note = tmp_path / "note.txt"
    note.write_text("mine")
    with pytest.raises(InvalidResults, match="neither empty nor of a benchmark"):
        run(tmp_path, small_row)
    with pytest.raises(InvalidResults, match="is a file"):
        run(note, small_row)
    assert list(tmp_path.iterdir()) == [note]


@pytest.mark.parametrize(
    "damage", [lambda text: text[:-40], lambda text: text.replace("small", "x")]
)
def test_a_damaged_part_is_named(small_row, tmp_path, damage):
    run(tmp_path, small_row, problems=1)
    (part,) = (tmp_path / "parts").iterdir()
    part.write_text(damage(part.read_text()))
    with pytest.raises(InvalidResults, match=f"{part.name}.* remove it"):
        run(tmp_path, small_row, problems=1)


def test_bad_requests_leave_nothing_behind(small_row, tmp_path, heading_weights):
    folder = tmp_path / "out"
    for problems, workers in ((0, 1), (1, 0)):
        with pytest.raises(InvalidParameter, match="must be >= 1"):
            run(folder, small_row, problems=problems, workers=workers)
    with pytest.raises(UnknownGuide):
        run(folder, small_row, settings=AccuracySettings(guides=("nothing",)))
    with pytest.raises(InvalidParameter, match="need headings"):
        run(folder, small_row, settings=AccuracySettings(guides=(heading_weights,)))
    assert not folder.exists()


@pytest.fixture
def started(tmp_path):
    """Starts a long benchmark as a process group of its own and waits for its first part."""
    script = tmp_path / "script.py"
    script.write_text(SCRIPT)

    def start(folder, workers):
        process = subprocess.Popen(
            [sys.executable, script, folder, str(workers)],
            start_new_session=True,
            stderr=subprocess.PIPE,
            text=True,
        )
        while not list((folder / "parts").glob("*.csv")):
            assert process.poll() is None, process.stderr.read()
            time.sleep(0.01)
        return process

    return start


@pytest.mark.parametrize("killed_by", [signal.SIGKILL, signal.SIGINT])
def test_a_run_that_is_killed_can_be_completed(small_row, tmp_path, started, killed_by):
    folder = tmp_path / "out"
    process = started(folder, workers=1)
    os.killpg(process.pid, killed_by)
    _, errors = process.communicate(timeout=60)
    assert errors.count("Traceback") == (killed_by == signal.SIGINT)  # the workers end quietly
    kept = len(list((folder / "parts").glob("*.csv")))
    run(folder, small_row, problems=4 * kept + 2)
    run(tmp_path / "whole", small_row, problems=4 * kept + 2)
    assert records(folder) == records(tmp_path / "whole")


def test_a_worker_that_is_killed_costs_its_problem_alone(small_row, tmp_path, started):
    folder = tmp_path / "out"
    process = started(folder, workers=2)
    children = subprocess.run(
        ["ps", "--ppid", str(process.pid), "-o", "pid="], capture_output=True, text=True, check=True
    ).stdout.split()
    victim = next(pid for pid in map(int, children) if b"spawn_main" in cmdline(pid))
    before = len(list((folder / "parts").glob("*.csv")))
    os.kill(victim, signal.SIGKILL)
    while len(list((folder / "parts").glob("*.csv"))) < before + 6:
        assert process.poll() is None, process.stderr.read()
        time.sleep(0.01)
    os.killpg(process.pid, signal.SIGINT)
    process.communicate(timeout=60)
    lost = {r.problem: r.cause for r in records(folder) if "died" in r.cause}
    assert list(lost.values()) == ["the process died with exit code -9"]


def cmdline(pid):
    return Path(f"/proc/{pid}/cmdline").read_bytes()


def test_a_map_that_has_changed_is_another_setting(tmp_path):
    grid = pf.generate_forest(seed=1, width=8.0, height=6.0)
    file = tmp_path / "hall.yaml"
    pf.save_map(grid, file)
    scene = Scene("", MapFile(file, grid.resolution), pf.PointRobot())
    run(tmp_path / "out", Row("hall", (scene,)), problems=1)
    occupied = grid.occupied.copy()
    occupied[:3, :3] ^= True
    pf.save_map(pf.OccupancyGrid(occupied, grid.resolution), file)
    with pytest.raises(InvalidResults, match=r"other settings: maps .*hall\.pgm"):
        run(tmp_path / "out", Row("hall", (scene,)), problems=2)


def test_what_a_kill_left_before_the_first_part_does_no_harm(small_row, tmp_path):
    (tmp_path / ".bench.json.4194305-0a1b2c3d.tmp").write_text("{")
    run(tmp_path, small_row, problems=1)
    assert not list(tmp_path.glob(".*.tmp"))
