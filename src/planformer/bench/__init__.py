"""Benchmarks: measured problem by problem, resumable, with intervals and the environment."""

from planformer.bench.accuracy import run_accuracy
from planformer.bench.measure import AccuracySettings

__all__ = ["AccuracySettings", "run_accuracy"]
