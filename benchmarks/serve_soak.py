"""Does the planning service hold at full load? More clients than turns, requests of every kind.

Counts requests that got no answer or a wrong one, how far searches went beyond their time limits,
and how the server's memory grew since the first fifth of the requests. A request that is refused
because all turns are taken is sent again, as clients do.

    python benchmarks/serve_soak.py --output benchmarks/results/serve/soak.json
"""

from __future__ import annotations

import asyncio
import random
import time
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any

import httpx
import numpy as np
import typer
from common import save_result
from rich.console import Console
from served import resident_megabytes, served

POINT = {"start": [2.0, 2.0], "goal": [22.0, 22.0]}
CAR = {
    "robot": {"kind": "dubins"},
    "start": [2.0, 2.0, 0.8],
    "goal": [22.0, 22.0, 0.8],
}
KINDS = {"plan": 56, "car": 8, "stream": 10, "compare": 2, "propose": 8, "image": 6, "edit": 8}
KINDS |= {"generate": 2}
PLANNERS = ("RRTstar", "InformedRRTstar", "BITstar", "RRTConnect")


@dataclass
class Tally:
    """What the clients saw."""

    answers: Counter[str] = field(default_factory=Counter)
    lost: list[str] = field(default_factory=list)
    overruns: list[float] = field(default_factory=list)
    beyond_limit: list[float] = field(default_factory=list)
    memory: list[float] = field(default_factory=list)

    def note_plan(self, plan: dict[str, Any], limit: float) -> None:
        """Note a plan's search time beyond its limit [s]."""
        self.overruns.append(plan["planning_seconds"] - limit)


class Client:
    """Sends requests about one map, one after the other."""

    def __init__(self, http: httpx.AsyncClient, map_id: str, seed: int, tally: Tally) -> None:
        self._http, self._map, self._tally = http, map_id, tally
        self._random = random.Random(seed)

    async def send(self) -> None:
        """Send one request until it is taken, and note its answer."""
        kind = self._random.choices(list(KINDS), list(KINDS.values()))[0]
        path, body = self._request(kind)
        while True:
            try:
                sent = time.perf_counter()
                response = await self._http.request("POST" if body else "GET", path, json=body)
            except httpx.HTTPError as error:
                self._tally.lost.append(f"{kind}: {type(error).__name__}")
                return
            self._tally.answers[f"{kind} {response.status_code}"] += 1
            if response.status_code != 429:
                break
            await asyncio.sleep(self._random.uniform(0.02, 0.2))
        self._check(kind, body, response, time.perf_counter() - sent)

    def _request(self, kind: str) -> tuple[str, dict[str, Any] | None]:
        seed = self._random.randrange(50)
        run = {"time_limit": self._random.choice((0.02, 0.05)), "seed": seed}
        run |= {"planner": self._random.choice(PLANNERS)}
        problem = {"map": self._map, **(CAR if kind == "car" else POINT)}
        if kind == "image":
            return f"/maps/{self._map}/image", None
        if kind == "generate":
            return "/maps/generate", {"kind": "maze", "seed": seed}
        if kind == "edit":
            place = [self._random.uniform(5.0, 19.0) for _ in range(2)]
            stroke = {"points": [place], "radius": 0.5, "occupied": True}
            return f"/maps/{self._map}/edit", {"strokes": [stroke]}
        if kind == "propose":
            return "/propose", problem
        if kind == "compare":
            return "/compare", {**problem, "runs": [run, {**run, "guide": None}]}
        options = {"tree": kind == "stream", "region": kind == "stream"}
        return "/plan/stream" if kind == "stream" else "/plan", {**problem, **run, **options}

    def _check(
        self, kind: str, body: dict[str, Any] | None, response: httpx.Response, seconds: float
    ) -> None:
        if response.status_code not in (200, 201):
            self._tally.lost.append(f"{kind}: {response.status_code} {response.text[:200]}")
        elif kind in ("plan", "car"):
            assert body is not None
            plan = response.json()
            self._tally.note_plan(plan, body["time_limit"])
            self._tally.beyond_limit.append(seconds - body["time_limit"])
        elif kind == "compare":
            assert body is not None
            for plan, run in zip(response.json()["results"], body["runs"], strict=True):
                self._tally.note_plan(plan, run["time_limit"])
        elif kind == "stream" and "event: result" not in response.text:
            self._tally.lost.append(f"stream without a result: {response.text[-200:]}")


async def soak(url: str, process: int, requests: int, clients: int) -> Tally:
    """Send requests from several clients at once."""
    tally, left = Tally(), iter(range(requests))
    async with httpx.AsyncClient(base_url=url, timeout=60.0) as http:
        made = await http.post("/maps/generate", json={"kind": "forest", "seed": 1})
        map_id = made.json()["id"]

        async def work(seed: int) -> None:
            client = Client(http, map_id, seed, tally)
            for number in left:
                if number % max(requests // 100, 1) == 0:
                    tally.memory.append(resident_megabytes(process))
                await client.send()

        await asyncio.gather(*(work(seed) for seed in range(clients)))
    return tally


def summary(tally: Tally, seconds: float) -> dict[str, Any]:
    """What to report."""
    fifth = len(tally.memory) // 5
    early, late = np.median(tally.memory[fifth : 2 * fifth]), np.median(tally.memory[-fifth:])
    return {
        "seconds": round(seconds, 1),
        "answers": dict(sorted(tally.answers.items())),
        "lost": len(tally.lost),
        "first_lost": tally.lost[:5],
        "searches": len(tally.overruns),
        "overrun_ms": _percentiles(tally.overruns),
        "request_beyond_time_limit_ms": _percentiles(tally.beyond_limit),
        "memory_mb": [
            round(value, 1) for value in tally.memory[:: max(len(tally.memory) // 20, 1)]
        ],
        "memory_growth_percent": round(100.0 * (late / early - 1.0), 2),
    }


def _percentiles(seconds: list[float]) -> dict[str, float]:
    values = 1e3 * np.asarray(seconds)
    return {f"p{q:g}": round(float(np.percentile(values, q)), 2) for q in (50, 90, 99, 100)}


def main(
    requests: Annotated[int, typer.Option(help="Requests altogether.")] = 10_000,
    clients: Annotated[int, typer.Option(help="Clients at once.")] = 8,
    plans: Annotated[int, typer.Option(help="Searches at once.")] = 2,
    output: Annotated[Path | None, typer.Option(help="Where to write the JSON.")] = None,
) -> None:
    """Load a server and report."""
    with served("--plans", str(plans)) as (url, process):
        started = time.perf_counter()
        tally = asyncio.run(soak(url, process, requests, clients))
        result = summary(tally, time.perf_counter() - started)
    Console().print_json(data=result)
    if output is not None:
        settings = {"requests": requests, "clients": clients, "plans": plans}
        save_result(output, settings, result)


if __name__ == "__main__":
    typer.run(main)
