"""Bring a page up to date with the results."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from planformer.bench.pages.blocks import block
from planformer.bench.pages.markers import filled
from planformer.errors import InvalidResults


def updated_page(page: Path, results: Path) -> str:
    """The text of a page with today's results between its markers.

    Args:
        page: A Markdown file with markers, see `planformer.bench.pages.markers`.
        results: Folder of all results.

    Raises:
        InvalidResults: The page cannot be read, its markers are wrong, or results are damaged.
    """
    try:
        text = page.read_text(encoding="utf-8")
        return filled(text, partial(block, results=results, page_folder=page.parent))
    except (OSError, UnicodeDecodeError) as error:
        raise InvalidResults(f"{page} cannot be read: {error}") from error
    except InvalidResults as error:
        raise InvalidResults(f"{page}: {error}") from error
