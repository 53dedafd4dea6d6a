from __future__ import annotations

import json
import os
import signal
import socket
import subprocess
import sys
import threading
import time

import httpx
import pytest

WITHOUT_FASTAPI = """
import sys
sys.modules["fastapi"] = None
from planformer.cli.app import main
main()
"""


@pytest.fixture
def started():
    """Start `planformer serve` on a free port; gives the process and a client."""
    processes, clients = [], []

    def start(*options):
        process = subprocess.Popen(
            [sys.executable, "-m", "planformer.cli", "serve", "--port", "0", *options],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            env={**os.environ, "COLUMNS": "200", "PYTHONUNBUFFERED": "1"},
        )
        processes.append(process)
        line = process.stdout.readline()
        assert line.startswith("planformer is at http://127.0.0.1:"), process.stderr.read()
        url = line.split()[3].rstrip(",")
        clients.append(httpx.Client(base_url=url, timeout=60.0))
        return process, clients[-1]

    yield start
    for client in clients:
        client.close()
    for process in processes:
        process.kill()
        process.communicate()


def a_problem(client):
    made = client.post("/maps/generate", json={"kind": "forest", "seed": 1}).json()
    return {"map": made["id"], "start": [2.0, 2.0], "goal": [22.0, 22.0], "time_limit": 60.0}


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_searches_and_streams_and_then_the_server(started, number):
    process, client = started("--max-seconds", "60")
    body = a_problem(client)
    answers = []
    plan = threading.Thread(target=lambda: answers.append(client.post("/plan", json=body)))
    plan.start()
    with client.stream("POST", "/plan/stream", json=body) as stream:
        texts = stream.iter_text()
        first = next(texts)
        begun = time.monotonic()
        process.send_signal(number)
        text = first + "".join(texts)
    plan.join()
    _, errors = process.communicate(timeout=60)
    assert time.monotonic() - begun < 30  # far below the limit of the searches
    assert (process.returncode, errors) == (0, "")
    assert answers[0].json()["status"] == "cancelled"
    last = text.strip().split("\n\n")[-1]
    assert last.startswith("event: result")
    assert json.loads(last.partition("data: ")[2])["status"] == "cancelled"


def test_options_are_the_service_s_limits(started, tmp_path):
    options = ("--plans", "3", "--max-seconds", "2", "--max-upload", "1", "--max-cells", "1000")
    _, client = started(*options, "--maps", str(tmp_path / "maps"))
    limits = client.get("/options").json()["limits"]
    wanted = {"plans": 3, "plan_seconds": 2.0, "upload_bytes": 2**20, "map_cells": 1000}
    assert wanted.items() <= limits.items()
    assert (tmp_path / "maps").is_dir()


def test_a_port_that_is_taken_is_an_error(cli):
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        result = cli("serve", "--port", port)
    assert result.exit_code == 2
    assert f"cannot listen on 127.0.0.1, port {port}" in result.output


def test_an_impossible_limit_is_an_error(cli):
    result = cli("serve", "--max-seconds", "-1")
    assert result.exit_code == 2
    assert "plan_seconds must be finite and > 0" in result.output


def test_without_the_extra_the_error_says_how_to_install_it():
    done = subprocess.run(
        [sys.executable, "-c", WITHOUT_FASTAPI, "serve"], capture_output=True, text=True
    )
    assert done.returncode == 2
    assert "pip install 'planformer[serve]'" in done.stderr
    assert "Traceback" not in done.stderr
