"""The accuracy of guides: do planners find good paths in their regions alone?"""

from planformer.bench.accuracy.measure import AccuracySettings
from planformer.bench.accuracy.report import markdown, table_cells
from planformer.bench.accuracy.run import run_accuracy

__all__ = ["AccuracySettings", "markdown", "run_accuracy", "table_cells"]
