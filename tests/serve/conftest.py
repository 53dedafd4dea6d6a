"""A real Uvicorn on a free port, in a thread of the test's process."""

from __future__ import annotations

import socket
import threading
from contextlib import ExitStack, contextmanager

import httpx
import pytest
import uvicorn

import planformer as pf
from planformer.serve import ServeSettings, create_app


@contextmanager
def running(app):
    """The address of a server of an application."""
    listener = socket.create_server(("127.0.0.1", 0))
    server = uvicorn.Server(uvicorn.Config(app, log_level="error"))
    thread = threading.Thread(target=server.run, kwargs={"sockets": [listener]})
    thread.start()
    try:
        yield f"http://127.0.0.1:{listener.getsockname()[1]}"
    finally:
        if hasattr(app.state, "service"):
            app.state.service.close()
        server.should_exit = True
        thread.join()
        listener.close()


@pytest.fixture(scope="session")
def server():
    settings = ServeSettings(plans=2, plan_seconds=60.0, patience_seconds=5.0)
    with running(create_app(settings)) as url:
        yield url


@pytest.fixture
def client(server):
    with httpx.Client(base_url=server, timeout=60.0) as client:
        yield client


@pytest.fixture
def make_server():
    """Start a server with settings of its own; gives a client of it."""
    with ExitStack() as stack:

        def make(**settings):
            url = stack.enter_context(running(create_app(ServeSettings(**settings))))
            return stack.enter_context(httpx.Client(base_url=url, timeout=60.0))

        yield make


@pytest.fixture
def room_files(room, tmp_path):
    """The room as the files of an upload."""
    pf.save_map(room, tmp_path / "room.yaml")
    return [
        ("files", (f"room.{s}", (tmp_path / f"room.{s}").read_bytes())) for s in ("yaml", "pgm")
    ]


@pytest.fixture
def room_id(client, room_files):
    return client.post("/maps", files=room_files).json()["id"]


@pytest.fixture
def problem(room_id):
    """A request to plan in the room, without a guide."""
    ends = {"start": [-1.2, -0.6], "goal": [1.2, -0.6]}
    return {"map": room_id, **ends, "guide": None, "time_limit": 20.0, "seed": 1}
