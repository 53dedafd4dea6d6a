"""A training from a source tree on a machine that has little more than PyTorch."""

from __future__ import annotations

import subprocess
import sys

import pytest

pytest.importorskip("torch", reason="training needs PyTorch")

ABSENT = "cv2 lightning_fabric matplotlib onnx onnxruntime PIL rich scipy typer yaml"

TRAIN = f"""
import runpy, sys
for name in "planformer._core {ABSENT}".split():
    sys.modules[name] = None
runpy.run_module("planformer.training", run_name="__main__", alter_sys=True)
"""


def test_needs_neither_core_nor_the_packages_of_planning(tmp_path):
    generate = pytest.importorskip("planformer.data.generate").generate_dataset
    kinds = ["forest", "indoor", "maze"]
    for part, seed in (("train", 0), ("val", 1)):
        folder = tmp_path / part
        generate(folder, kinds=kinds, maps=1, paths_per_map=2, seed=seed, workers=1)
    options = [
        "--preset",
        "tiny",
        "--steps",
        "2",
        "--batch-size",
        "2",
        "--workers",
        "0",
        "--threads",
        "1",
        "--devices",
        "1",
    ]
    done = subprocess.run(
        [sys.executable, "-c", TRAIN, "--data", tmp_path, "--output", tmp_path / "run", *options],
        capture_output=True,
        text=True,
        timeout=600,
    )
    assert done.returncode == 0, done.stderr
    assert "2 steps, finished" in done.stdout
