from __future__ import annotations

import json
import os
import subprocess
import sys

import pytest
from typer.testing import CliRunner

import planformer as pf
from planformer.cli.app import app


@pytest.fixture
def room_file(room, tmp_path):
    path = tmp_path / "room.yaml"
    pf.save_map(room, path)
    return path


@pytest.fixture
def cli():
    """Run a command in this process; everything it prints is in `.output`."""

    def run(*args):
        return CliRunner().invoke(app, [str(arg) for arg in args])

    return run


@pytest.fixture
def plan_json(cli):
    """Run `plan --json` without a guide; returns the exit code and the record."""

    def run(*args):
        result = cli("plan", *args, "--guide", "none", "--json")
        return result.exit_code, json.loads(result.stdout)

    return run


@pytest.fixture
def shell():
    """Run the command line as a process of its own."""

    def run(*args, **options):
        return subprocess.run(
            [sys.executable, "-m", "planformer.cli", *map(str, args)],
            capture_output=True,
            text=True,
            timeout=120,
            env={**os.environ, "COLUMNS": "80"},
            **options,
        )

    return run
