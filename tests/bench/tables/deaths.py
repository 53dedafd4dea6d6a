"""What takes a worker process down in the tests; the processes import it by name."""

from __future__ import annotations

import os
import signal

from planformer.bench.tables import TableSettings
from planformer.bench.tables.systems import POINT_SYSTEMS, GridSearch


def die(problem, seed):
    os.kill(os.getpid(), signal.SIGKILL)


class WithASystemThatDies(TableSettings):
    """Two systems, and one that takes its process down."""

    def __post_init__(self):
        """Let the names be."""

    def systems_of(self, row):
        systems = {
            "RRT*": POINT_SYSTEMS["RRT*"],
            "dies": GridSearch(die),
            "Lazy Theta*": POINT_SYSTEMS["Lazy Theta*"],
        }
        return {name: s for name, s in systems.items() if name in (self.systems or systems)}


class DeadlyMaps:
    """Maps whose making takes the process down."""

    def grid(self, seed):
        os.kill(os.getpid(), signal.SIGKILL)
