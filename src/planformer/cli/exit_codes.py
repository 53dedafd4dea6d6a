"""What the exit codes of `planformer` mean."""

from __future__ import annotations

SOLVED = 0
NO_PATH = 1
BAD_INPUT = 2
INTERRUPTED = 130
"""128 + SIGINT, as shells report it."""
BROKEN_PIPE = 141
"""128 + SIGPIPE, as shells report it."""
