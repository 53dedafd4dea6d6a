"""Health, metrics, the page, the documentation, embedding and settings."""

from __future__ import annotations

import asyncio
import re
import threading

import httpx
import pytest
from fastapi import FastAPI

import planformer as pf
from planformer.errors import Busy, InvalidParameter, ShuttingDown
from planformer.serve import ServeSettings, create_app
from planformer.serve.service import Service

from .conftest import running


def test_health_states_the_version(client):
    assert client.get("/health").json() == {"status": "ok", "version": pf.__version__}


def test_metrics_count_requests_and_plans(make_server, room_files):
    client = make_server()
    room = client.post("/maps", files=room_files).json()["id"]
    body = {"map": room, "start": [-1.2, -0.6], "goal": [1.2, -0.6], "time_limit": 0.05}
    client.post("/plan", json=body)
    client.get(f"/maps/{room}/image")
    client.get("/no/such/route")
    client.request("INVENTED", "/health")
    text = client.get("/metrics").text
    for line in (
        'planformer_plans_total{planner="BITstar",status="time limit"} 1.0',
        'planformer_requests_total{method="POST",route="/plan",status="200"} 1.0',
        'planformer_requests_total{method="GET",route="/maps/{map_id}/image",status="200"} 1.0',
        "planformer_plans_running 0.0",
        "planformer_map_cells 2400.0",
    ):
        assert line in text
    assert "/no/such/route" not in text
    assert "INVENTED" not in text
    assert "process_resident_memory_bytes" in text


def test_the_page_is_served_with_what_it_loads(client):
    page = client.get("/")
    assert page.headers["content-type"].startswith("text/html")
    assert "default-src 'self'" in page.headers["content-security-policy"]
    files = re.findall(r'(?:src|href)="\.?/?(assets/[^"]+)"', page.text)
    assert files
    assert all(client.get(f"/{file}").status_code == 200 for file in files)


@pytest.mark.parametrize("path", ["/assets/../settings.py", "/assets/%2e%2e/%2e%2e/app.py"])
def test_only_the_page_s_files_are_served(client, path):
    assert client.get(path).status_code == 404


def test_the_documentation_needs_no_other_server(client):
    page = client.get("/docs").text
    links = re.findall(r'(?:src|href)="([^"]+)"', page)
    assert links
    assert all(client.get(link).status_code == 200 for link in links)


def test_every_field_of_the_api_is_described(client):
    description = client.get("/openapi.json").json()
    for path, methods in description["paths"].items():
        for method in methods.values():
            assert method.get("summary"), path
    units = {
        ("PlanResponse", "length"): "[m]",
        ("PlanResponse", "planning_seconds"): "[s]",
        ("MapInfo", "resolution"): "[m]",
        ("PlanRequest", "start"): "rad",
        ("RegionResponse", "anchor_size"): "[m]",
        ("ProgressResponse", "length"): "[m]",
        ("TreeUpdate", "curves"): "[m]",
    }
    for (schema, field), unit in units.items():
        properties = description["components"]["schemas"][schema]["properties"]
        assert unit in properties[field]["description"]


def test_it_can_be_part_of_another_application(room_files):
    fleet = FastAPI()
    planning = create_app(ServeSettings(hosts=None))
    fleet.mount("/planning", planning)
    with running(fleet) as url, httpx.Client(base_url=f"{url}/planning", timeout=60.0) as client:
        room = client.post("/maps", files=room_files).json()["id"]
        body = {"map": room, "start": [-1.2, -0.6], "goal": [1.2, -0.6], "time_limit": 0.05}
        assert client.post("/plan", json=body).json()["solved"]
        planning.state.service.close()
        refused = client.post("/plan", json=body)
    assert (refused.status_code, refused.json()["error"]) == (503, "ShuttingDown")
    assert refused.headers["retry-after"] == "5"


@pytest.mark.parametrize(
    "wrong",
    [
        {"plans": 0},
        {"plan_seconds": float("inf")},
        {"upload_bytes": -1},
        {"patience_seconds": float("nan")},
        {"map_cells": 100, "cells_in_memory": 99},
    ],
)
def test_impossible_settings_are_refused(wrong):
    with pytest.raises(InvalidParameter, match=next(iter(wrong))):
        ServeSettings(**wrong)


def test_a_folder_that_cannot_be_made_is_refused(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(InvalidParameter, match="cannot be made"):
        create_app(ServeSettings(folder=tmp_path / "file" / "maps"))


def test_work_on_maps_waits_in_a_short_queue():
    async def flood():
        service, release = Service(ServeSettings()), threading.Event()
        waiting = [asyncio.ensure_future(service.in_thread(release.wait)) for _ in range(32)]
        await asyncio.sleep(0)
        with pytest.raises(Busy):
            await service.in_thread(release.wait)
        service.close()
        with pytest.raises(ShuttingDown):
            await service.in_thread(release.wait)
        release.set()
        return await asyncio.gather(*waiting, return_exceptions=True)

    ends = asyncio.run(flood())
    assert ends.count(True) == 2  # those that ran
    assert sum(isinstance(end, ShuttingDown) for end in ends) == 30
