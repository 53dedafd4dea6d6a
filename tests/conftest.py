from __future__ import annotations

import signal
from pathlib import Path

import hypothesis
import numpy as np
import pytest

import planformer as pf

# A shell's background jobs ignore Ctrl-C, and so would the processes that tests interrupt.
signal.signal(signal.SIGINT, signal.default_int_handler)

# How long an example takes says nothing on a busy machine.
hypothesis.settings.register_profile("planformer", deadline=None)
hypothesis.settings.load_profile("planformer")


@pytest.fixture(scope="session")
def real_maps() -> Path:
    """The folder of real maps that lies beside the checkout."""
    folder = Path(__file__).resolve().parents[2] / "shared" / "maps"
    if not folder.is_dir():
        pytest.skip("the real maps (../shared/maps beside the checkout) are not here")
    return folder


@pytest.fixture
def room():
    """3 x 2 m round the world's origin with a wall that leaves a passage at the top."""
    occupied = np.zeros((40, 60), bool)
    occupied[:28, 30] = True
    return pf.OccupancyGrid(occupied, 0.05, origin=(-1.5, -1.0))
