"""The API against its own OpenAPI description: no answer that it does not describe."""

from __future__ import annotations

import httpx
import pytest
import schemathesis
from hypothesis import HealthCheck, given, settings
from schemathesis import GenerationMode
from schemathesis.checks import positive_data_acceptance

import planformer as pf
from planformer.serve import ServeSettings, create_app

from .conftest import running

SETTINGS = ServeSettings(
    plans=2, plan_seconds=0.1, patience_seconds=30.0, map_cells=40_000, cells_in_memory=400_000
)


OPERATIONS = [
    found.ok()
    for found in schemathesis.openapi.from_dict(create_app(SETTINGS).openapi()).get_all_operations()
]


@pytest.fixture(scope="module")
def url():
    with running(create_app(SETTINGS)) as url:
        yield url


@pytest.fixture(scope="module")
def forest(url):
    """Id of a map that every second request is about."""
    request = {"kind": "forest", "seed": 4, "width": 8.0, "height": 8.0}
    return httpx.post(f"{url}/maps/generate", json=request).json()["id"]


@pytest.mark.parametrize(
    ("operation", "mode"),
    [
        pytest.param(operation, mode, id=f"{operation.label} {mode.value}")
        for operation in OPERATIONS
        for mode in GenerationMode
        # Without parameters there is nothing to get wrong.
        if mode.is_positive or len(operation.body) or len(operation.path_parameters)
    ],
)
def test_no_request_surprises_the_server(url, forest, operation, mode):
    @settings(max_examples=40, derandomize=True, suppress_health_check=list(HealthCheck))
    @given(operation.as_strategy(generation_mode=mode))
    def check(case):
        if mode.is_positive:  # what is wrong has to stay wrong
            aim_at(case, forest)
        # Well-formed problems may still have a start in an obstacle: that they fail is right.
        case.call_and_validate(base_url=url, excluded_checks=[positive_data_acceptance])

    check()


def aim_at(case, forest):
    """Let a part of the requests that would not find their map find one, and end soon."""
    if case.method == "DELETE":
        return
    if "map_id" in (case.path_parameters or {}) and len(case.path_parameters["map_id"]) % 2 == 0:
        case.path_parameters["map_id"] = forest
    body = case.body
    if not isinstance(body, dict):
        return
    if isinstance(body.get("map"), str) and not len(str(body)) % 3:
        body["map"] = forest
        for end, place in (("start", (1.0, 1.2)), ("goal", (6.0, 6.0))):
            if isinstance(body.get(end), list) and len(str(body)) % 2:
                body[end] = [*place, *body[end][2:]]
    for options in (body, *(body.get("runs") or ())):
        if isinstance(options, dict) and isinstance(options.get("time_limit"), float):
            options["time_limit"] = min(options["time_limit"], 0.05)


def test_the_fuzzer_s_map_can_be_planned_on(forest):
    grid = pf.generate_forest(4, width=8.0, height=8.0)
    assert grid.components(0.1)[tuple(grid.to_rc((1.0, 1.2)))] > 0
    assert grid.components(0.1)[tuple(grid.to_rc((6.0, 6.0)))] > 0
