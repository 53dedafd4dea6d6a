"""What worker processes are asked to do in the tests; they import it by name."""

from __future__ import annotations

import os
import signal
import time


def double(value):
    return 2 * value


def sleep(seconds):
    time.sleep(seconds)
    return os.getpid()


def die_at_three(value):
    if value == 3:
        os.kill(os.getpid(), signal.SIGKILL)
    return value


def fail_at_three(value):
    if value == 3:
        raise ValueError("three")
    return value
