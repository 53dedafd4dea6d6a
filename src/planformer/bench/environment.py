"""What a reader needs to judge or repeat a measurement."""

from __future__ import annotations

import platform
import re
import shlex
import subprocess
import sys
from datetime import datetime, timezone
from pathlib import Path
from typing import Any

import numpy as np

import planformer
from planformer.processes import cores

_SOURCES = Path(__file__).resolve().parents[3]
_CODE = ("src", "cpp", "benchmarks/*.py")
"""What measurements depend on; their own results do not change the code."""


def environment() -> dict[str, Any]:
    """Machine, versions and command as JSON-compatible values."""
    return {
        "command": _command(),
        "commit": _commit(),
        "date": datetime.now(timezone.utc).date().isoformat(),
        **machine(),
        "planformer": planformer.__version__,
        "python": platform.python_version(),
        "numpy": np.__version__,
        "onnxruntime": _onnxruntime_version(),
        "ompl": _ompl_version(),
    }


def machine() -> dict[str, Any]:
    """What times depend on most: the processor and how many cores this process may use."""
    return {"cpu": _cpu_model(), "cores": cores()}


def _command() -> str:
    program, arguments = Path(sys.argv[0]), sys.argv[1:]
    if program.name == "__main__.py":  # python -m planformer.cli
        return shlex.join(["planformer", *arguments])
    return shlex.join([*(["python"] if program.suffix else []), program.name, *arguments])


def _commit() -> str | None:
    """Commit of the sources, with + for changes of the code since; None outside of git."""
    if not (_SOURCES / ".git").exists():
        return None
    head = _git("rev-parse", "--short", "HEAD")
    changes = _git("status", "--porcelain", "--untracked-files=no", "--", *_CODE)
    return head + "+" * bool(changes) if head else None


def _git(*arguments: str) -> str:
    command = ["git", "-C", str(_SOURCES), *arguments]
    try:
        return subprocess.run(command, capture_output=True, text=True, check=False).stdout.strip()
    except OSError:  # git is not installed
        return ""


def _cpu_model() -> str:
    cpuinfo = Path("/proc/cpuinfo")
    lines = cpuinfo.read_text(encoding="utf-8").splitlines() if cpuinfo.exists() else []
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor()


def _onnxruntime_version() -> str:
    import onnxruntime

    return str(onnxruntime.__version__)


def _ompl_version() -> str | None:
    """Version of the OMPL that the core has loaded, as its file name says."""
    import planformer._core  # noqa: F401  # loads it

    maps = Path("/proc/self/maps")
    loaded = maps.read_text(encoding="utf-8") if maps.exists() else ""
    found = re.search(r"libompl[^/\s]*\.so\.([\d.]+)", loaded)
    return found.group(1) if found else None
