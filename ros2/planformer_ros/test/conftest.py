from __future__ import annotations

import signal
from pathlib import Path

import hypothesis
import pytest
import rclpy

from client import Client, Planner

# A shell's background jobs ignore Ctrl-C, and so would the processes that tests interrupt.
signal.signal(signal.SIGINT, signal.default_int_handler)

hypothesis.settings.register_profile("planformer", deadline=None)
hypothesis.settings.load_profile("planformer")


@pytest.fixture(scope="session")
def maps() -> Path:
    """The folder of real maps that lies beside the checkout."""
    folder = Path(__file__).resolve().parents[4] / "shared" / "maps"
    if not folder.is_dir():
        pytest.skip("the real maps (../shared/maps beside the checkout) are not here")
    return folder


@pytest.fixture(scope="session", autouse=True)
def _ros():
    rclpy.init()
    yield
    rclpy.try_shutdown()


@pytest.fixture
def client():
    """A ROS node of this process that talks to the planner."""
    with Client() as client:
        yield client


@pytest.fixture
def planner(tmp_path):
    """The planner in a process of its own, active, with a long time limit.

    It ends with the test: a second one would answer in place of one that a test starts itself.
    """
    with Planner(tmp_path, autostart=True, time_limit=60.0) as planner:
        yield planner
