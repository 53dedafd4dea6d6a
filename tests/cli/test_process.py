"""What only a process of its own can show: Ctrl-C, closed pipes, what is imported."""

from __future__ import annotations

import json
import os
import subprocess
import sys

from planformer.cli.exit_codes import BROKEN_PIPE, INTERRUPTED

ENDS = ("--start", "-1.2", "-0.6", "--goal", "1.2", "-0.6", "--guide", "none")

INTERRUPT_ITSELF = """
import os, signal, sys, threading
import planformer.cli.report, planformer.guidance
from planformer.cli.app import main
threading.Timer(1.5, os.kill, (os.getpid(), signal.SIGINT)).start()
main()
"""


def test_interrupt_keeps_the_best_path(room_file, tmp_path):
    options = (*ENDS, "--time-limit", "100", "--output", str(tmp_path / "out"), "--no-picture")
    done = subprocess.run(
        [sys.executable, "-c", INTERRUPT_ITSELF, "plan", str(room_file), *options],
        capture_output=True,
        text=True,
        timeout=90,
    )
    assert done.returncode == INTERRUPTED, done.stderr
    assert "Traceback" not in done.stderr
    record = json.loads((tmp_path / "out" / "path.json").read_text())
    assert (record["solved"], record["status"]) == (True, "cancelled")


def test_interrupted_generation_can_be_completed(shell, tmp_path):
    folder = tmp_path / "data"
    options = ("generate", str(folder), "--maps", "500", "--workers", "1", "--paths-per-map", "20")
    done = subprocess.run(
        [sys.executable, "-c", INTERRUPT_ITSELF, *options],
        capture_output=True,
        text=True,
        timeout=90,
    )
    assert done.returncode == INTERRUPTED, done.stderr
    assert "Traceback" not in done.stderr
    assert not list(folder.glob("*.tmp"))


def test_closed_pipe_ends_quietly(room_file):
    read, write = os.pipe()
    os.close(read)
    with os.fdopen(write, "w") as closed:
        done = subprocess.run(
            [
                sys.executable,
                "-m",
                "planformer.cli",
                "plan",
                str(room_file),
                *ENDS,
                "--planner",
                "RRTConnect",
                "--json",
            ],
            stdout=closed,
            stderr=subprocess.PIPE,
            text=True,
            timeout=60,
        )
    assert (done.returncode, done.stderr) == (BROKEN_PIPE, "")


def test_commands_that_need_torch_say_how_to_install_it(tmp_path):
    without_torch = "import sys; sys.modules['torch'] = None; sys.argv[0] = 'planformer'\n"
    run_main = "from planformer.cli.app import main; main()"
    for args in (("train", "data", "run"), ("export", "run/checkpoint.pt", "w.onnx")):
        done = subprocess.run(
            [sys.executable, "-c", without_torch + run_main, *args],
            capture_output=True,
            text=True,
            timeout=60,
            cwd=tmp_path,
        )
        assert done.returncode == 2, done.stderr
        assert "pip install 'planformer[train]'" in done.stderr
        assert "Traceback" not in done.stderr


def test_planning_imports_neither_torch_nor_pyplot(room_file, tmp_path):
    program = (
        "import sys, planformer.cli.app as cli\n"
        "try: cli.main()\n"
        "finally: print([n for n in ('torch', 'matplotlib.pyplot') if n in sys.modules])"
    )
    options = (*ENDS, "--planner", "RRTConnect", "--output", str(tmp_path / "out"))
    done = subprocess.run(
        [sys.executable, "-c", program, "plan", str(room_file), *options],
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.endswith("[]\n")
