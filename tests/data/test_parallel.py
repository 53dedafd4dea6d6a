from __future__ import annotations

import json
import os
import subprocess
import sys
import time

import pytest

from planformer.data.parallel import solved_in_order
from planformer.errors import InvalidDataset, InvalidParameter, MissingExtra


def negated(job):
    time.sleep(0.01 * (job % 3))
    return -job


def killed(job):
    os._exit(1)


def long(job):
    if job:
        time.sleep(600)
    return job


def refused(job):
    raise InvalidParameter(f"job {job}")


@pytest.mark.parametrize("workers", [1, 2])
def test_results_come_in_order(workers):
    results = list(solved_in_order(negated, range(30), workers=workers))
    assert results == [-job for job in range(30)]


@pytest.mark.parametrize("workers", [1, 2])
def test_only_a_few_jobs_are_under_way(workers):
    taken = []

    def jobs():
        for job in range(1000):
            taken.append(job)
            yield job

    results = solved_in_order(negated, jobs(), workers=workers)
    assert next(results) == 0
    results.close()
    assert len(taken) <= 4 * workers


def test_jobs_under_way_are_given_up_with_the_generator():
    results = solved_in_order(long, range(8), workers=2)
    assert next(results) == 0
    results.close()  # returns before the ten minutes of the others are over


@pytest.mark.parametrize("workers", [1, 2])
def test_errors_reach_the_caller(workers):
    with pytest.raises(InvalidParameter, match="job 7"):
        list(solved_in_order(refused, [7], workers=workers))


def test_a_killed_worker_is_an_error_that_says_what_to_do():
    with pytest.raises(InvalidDataset, match="a worker process was killed"):
        list(solved_in_order(killed, range(3), workers=2))


def test_without_ray_the_error_says_how_to_install_it(monkeypatch):
    monkeypatch.setitem(sys.modules, "ray", None)
    with pytest.raises(MissingExtra, match=r"pip install 'planformer\[cluster\]'"):
        list(solved_in_order(negated, [1], workers=1, ray_address="auto"))


RAY = """
import json, sys
from planformer.data.generate import generate_dataset
from planformer.errors import InvalidParameter
if __name__ == "__main__":
    folder, settings = sys.argv[1], json.loads(sys.argv[2])
    try:
        generate_dataset(folder, ray_address="auto", **settings)
    except InvalidParameter as error:
        assert "no Ray cluster at 'auto'" in str(error)
    generate_dataset(folder, ray_address="local", workers=2, **settings)
    try:
        generate_dataset(folder + "2", ray_address="local", **settings | {"min_distance": 50})
    except InvalidParameter as error:
        assert "forest number 0: only 0 of" in str(error)
    else:
        raise SystemExit(3)
"""


def test_a_ray_cluster_makes_the_same_data_set(small_dataset, small_settings, tmp_path):
    # In a process of its own: Ray leaves threads and sockets behind.
    pytest.importorskip("ray")
    (tmp_path / "script.py").write_text(RAY, encoding="utf-8")
    environment = {"RAY_USAGE_STATS_ENABLED": "0", "RAY_AUTH_MODE": "disabled"}
    done = subprocess.run(
        [sys.executable, "script.py", str(tmp_path / "ray"), json.dumps(small_settings)],
        env={key: v for key, v in os.environ.items() if key != "RAY_ADDRESS"} | environment,
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert done.returncode == 0, done.stderr
    for file in small_dataset.iterdir():
        assert (tmp_path / "ray" / file.name).read_bytes() == file.read_bytes()
