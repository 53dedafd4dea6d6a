"""Cores, and child processes that leave Ctrl-C to their parent."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from contextlib import contextmanager


def cores() -> int:
    """How many cores this process may use."""
    return len(os.sched_getaffinity(0))


@contextmanager
def interrupts_left_to_parent() -> Iterator[None]:
    """Start processes in this block that Ctrl-C never reaches; here it is held back meanwhile.

    Ctrl-C goes to the whole process group, but is the parent's alone to handle. Children that
    ignored it in code of their own would still die of it, with a traceback, while they start; the
    signal mask they inherit.
    """
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
