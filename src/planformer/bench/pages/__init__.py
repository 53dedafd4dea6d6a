"""Pages whose tables come from the files of results, between markers in their text."""

from planformer.bench.pages.blocks import block_names
from planformer.bench.pages.markers import filled
from planformer.bench.pages.update import updated_page

__all__ = ["block_names", "filled", "updated_page"]
