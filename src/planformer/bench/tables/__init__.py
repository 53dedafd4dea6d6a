"""The paper's tables: planners, guided and not, and what a sceptic would use instead."""

from planformer.bench.tables.measure import TableSettings
from planformer.bench.tables.run import TABLES, run_table, table_rows

__all__ = ["TABLES", "TableSettings", "run_table", "table_rows"]
