"""Markers in a page, comments in Markdown, and what stands between them.

<!-- table1:begin -->
replaced by the block table1
<!-- table1:end -->
"""

from __future__ import annotations

import re
from collections.abc import Callable

from planformer.errors import InvalidResults

_MARKER = re.compile(r"<!-- [\w-]+:(?:begin|end) -->")
_MARKED = re.compile(r"<!-- ([\w-]+):begin -->\n.*?<!-- \1:end -->", re.DOTALL)


def filled(text: str, block: Callable[[str], str]) -> str:
    """Replace what stands between the markers of a text.

    Args:
        text: Markdown, with markers on lines of their own.
        block: Gives the Markdown that belongs between the markers of a name.

    Raises:
        InvalidResults: The text has no markers, or some that do not pair up.
    """

    def fill(marked: re.Match[str]) -> str:
        name = marked[1]
        return f"<!-- {name}:begin -->\n\n{block(name).strip()}\n\n<!-- {name}:end -->"

    new, pairs = _MARKED.subn(fill, text)
    markers = _MARKER.findall(text)
    if pairs == 0 or len(markers) != 2 * pairs:
        raise InvalidResults(
            "a page needs pairs of lines <!-- NAME:begin --> and <!-- NAME:end -->, none inside "
            f"another; got {', '.join(markers) or 'none'}"
        )
    return new
