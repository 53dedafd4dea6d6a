"""Benchmarks: measured problem by problem, resumable, with intervals and the environment."""

from planformer.bench.accuracy import AccuracySettings, run_accuracy

__all__ = ["AccuracySettings", "run_accuracy"]
