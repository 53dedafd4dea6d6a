"""What does HTTP cost? POST /plan beside the time that the library itself needs.

Guided plans on a forest of 480 x 480 cells, each to its first path, over one kept connection. The
difference is taken request by request: time until the whole answer is there, less the seconds of
proposal and search that the answer states.

    python benchmarks/serve_latency.py --output benchmarks/results/serve/latency.json
"""

from __future__ import annotations

import json
import time
from contextlib import closing
from http.client import HTTPConnection
from pathlib import Path
from typing import Annotated, Any
from urllib.parse import urlsplit

import numpy as np
import typer
from common import interval, save_result
from rich.console import Console
from served import served

PROBLEM = {"start": [2.0, 2.0], "goal": [22.0, 22.0], "target_length": 1000.0}
VARIANTS: dict[str, dict[str, Any]] = {
    "path": {},
    "path and region": {"region": True},
    "path and tree": {"tree": True},
}
WARM_UP = 20


def measure(connection: HTTPConnection, body: dict[str, Any], requests: int) -> np.ndarray:
    """(requests,) milliseconds of each request above the library's own time."""
    above = []
    for seed in range(requests + WARM_UP):
        started = time.perf_counter()
        answer = post(connection, "/plan", {**body, "seed": seed})
        seconds = time.perf_counter() - started
        above.append(1e3 * (seconds - json.loads(answer)["total_seconds"]))
    return np.array(above[WARM_UP:])


def post(connection: HTTPConnection, path: str, body: dict[str, Any]) -> bytes:
    """The answer to a request."""
    connection.request("POST", path, json.dumps(body), {"Content-Type": "application/json"})
    with connection.getresponse() as response:
        answer = response.read()
    if response.status >= 300:
        raise RuntimeError(answer.decode())
    return answer


def main(
    requests: Annotated[int, typer.Option(help="Requests of each variant.")] = 1000,
    output: Annotated[Path | None, typer.Option(help="Where to write the JSON.")] = None,
) -> None:
    """Measure and report."""
    result: dict[str, Any] = {}
    with served() as (url, _), closing(HTTPConnection(urlsplit(url).netloc)) as connection:
        made = json.loads(post(connection, "/maps/generate", {"kind": "forest", "seed": 1}))
        for name, options in VARIANTS.items():
            above = measure(connection, {"map": made["id"], **PROBLEM, **options}, requests)
            result[name] = {
                "p50_ms": interval(above, np.median),
                "p90_ms": round(float(np.percentile(above, 90)), 3),
                "p99_ms": round(float(np.percentile(above, 99)), 3),
            }
    Console().print_json(data=result)
    if output is not None:
        save_result(output, {"requests": requests}, result)


if __name__ == "__main__":
    typer.run(main)
