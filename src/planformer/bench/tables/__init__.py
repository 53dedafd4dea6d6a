"""The paper's tables: planners, guided and not, and what a sceptic would use instead."""

from planformer.bench.tables.measure import TableSettings
from planformer.bench.tables.run import TABLES, run_table

__all__ = ["TABLES", "TableSettings", "run_table"]
