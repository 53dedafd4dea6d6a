"""Full servers, clients that go away, and the end of a server."""

from __future__ import annotations

import contextlib
import threading
import time

import httpx
import pytest

from .test_errors import expect
from .test_stream import running


@pytest.fixture
def endless(problem):
    """A plan that takes until it is cancelled."""
    return problem | {"time_limit": 600.0}


def settings(**more):
    return {"plans": 1, "plan_seconds": 600.0, "patience_seconds": 0.1, **more}


def wait_until(condition):
    deadline = time.monotonic() + 60
    while not condition():
        assert time.monotonic() < deadline
        time.sleep(0.01)


class Leaver:
    """A client in a thread of its own that sends a request and can be made to go away."""

    def __init__(self, client, path, body):
        self._client = httpx.Client(base_url=client.base_url, timeout=None)
        self.response = None
        self._thread = threading.Thread(target=self._send, args=(path, body))
        self._thread.start()

    def _send(self, path, body):
        with contextlib.suppress(httpx.TransportError):
            self.response = self._client.post(path, json=body)

    def leave(self):
        pool = self._client._transport._pool
        for connection in pool.connections:
            connection._connection._network_stream.get_extra_info("socket").shutdown(2)
        self.join()

    def join(self):
        self._thread.join()
        self._client.close()


@pytest.fixture
def one_at_a_time(make_server, room_files):
    client = make_server(**settings())
    client.post("/maps", files=room_files)
    return client


@pytest.mark.parametrize("path", ["/plan", "/compare"])
def test_a_client_that_leaves_ends_its_search(one_at_a_time, endless, path):
    body = endless
    if path == "/compare":
        ends = {key: endless[key] for key in ("map", "start", "goal")}
        body = {**ends, "runs": [{"time_limit": 600.0, "guide": None}] * 4}
    leaver = Leaver(one_at_a_time, path, body)
    wait_until(lambda: running(one_at_a_time) == 1)
    leaver.leave()
    wait_until(lambda: running(one_at_a_time) == 0)
    assert 'status="cancelled"' in one_at_a_time.get("/metrics").text


@pytest.mark.parametrize("path", ["/plan", "/plan/stream", "/propose", "/compare"])
def test_a_busy_server_says_when_to_come_back(one_at_a_time, endless, path):
    leaver = Leaver(one_at_a_time, "/plan", endless)
    wait_until(lambda: running(one_at_a_time) == 1)
    ends = {key: endless[key] for key in ("map", "start", "goal")}
    body = {**ends, "runs": [{}]} if path == "/compare" else ends
    response = one_at_a_time.post(path, json=body)
    expect(response, 429, "Busy")
    assert response.headers["retry-after"] == "1"
    assert one_at_a_time.get("/health").json()["status"] == "ok"
    assert one_at_a_time.get(f"/maps/{endless['map']}/image").status_code == 200
    leaver.leave()
    wait_until(lambda: running(one_at_a_time) == 0)
    assert one_at_a_time.post("/plan", json={**ends, "time_limit": 0.05}).status_code == 200


def test_a_request_waits_a_little_for_its_turn(make_server, room_files, problem):
    client = make_server(**settings(patience_seconds=30.0))
    client.post("/maps", files=room_files)
    first = Leaver(client, "/plan", problem | {"time_limit": 0.5})
    wait_until(lambda: running(client) == 1 or first.response is not None)
    assert client.post("/plan", json=problem | {"time_limit": 0.05}).status_code == 200
    first.join()
    assert first.response.status_code == 200


def test_more_requests_than_turns_are_all_answered(make_server, room_files, problem):
    client = make_server(**settings(plans=2, patience_seconds=0.01))
    client.post("/maps", files=room_files)
    many = [Leaver(client, "/plan", problem | {"time_limit": 0.2}) for _ in range(12)]
    for one in many:
        one.join()
    codes = [one.response.status_code for one in many]
    assert set(codes) <= {200, 429}
    assert codes.count(200) >= 2
    assert running(client) == 0


def test_the_time_limit_is_kept_under_load(make_server, room_files, problem):
    client = make_server(**settings(plans=4, patience_seconds=60.0))
    client.post("/maps", files=room_files)
    many = [Leaver(client, "/plan", problem | {"time_limit": 0.1}) for _ in range(8)]
    for one in many:
        one.join()
    assert all(one.response.json()["status"] == "time limit" for one in many)
