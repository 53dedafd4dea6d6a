from __future__ import annotations

import json

import pytest

ABSENT = "0123456789abcdef"


def expect(response, status, error):
    assert (response.status_code, response.json()["error"]) == (status, error), response.text
    return response.json()


def test_an_occupied_start_names_the_nearest_free_point(client, room, problem):
    body = expect(client.post("/plan", json=problem | {"start": [0.0, -0.9]}), 400, "StartOccupied")
    assert body["details"]["nearest_free"] == list(room.nearest_free((0.0, -0.9), 0.1))
    assert "nearest free point" in body["message"]


@pytest.mark.parametrize(
    ("change", "error"),
    [
        ({"goal": [0.0, -0.9]}, "GoalOccupied"),
        ({"start": [9.0, 9.0]}, "StartOutsideMap"),
        ({"goal": [-1e300, 0.0]}, "GoalOutsideMap"),
        ({"start": [0.5, 0.5, 0.0]}, "InvalidProblem"),
        ({"planner": "Teleport"}, "UnknownPlanner"),
        ({"planner": "SST"}, "UnknownPlanner"),
        ({"guide": "oracle"}, "UnknownGuide"),
        ({"guide": "/etc/passwd.onnx"}, "UnknownGuide"),
        ({"guide": "../weights/mpt_small.forest_maze_indoor"}, "UnknownGuide"),
        ({"guide": "mpt-dubins"}, "WeightsMismatch"),
        ({"time_limit": 61.0}, "InvalidParameter"),
        ({"max_vertices": 10**9}, "InvalidParameter"),
    ],
)
def test_a_bad_problem_is_a_typed_error(client, problem, change, error):
    expect(client.post("/plan", json=problem | change), 400, error)


@pytest.mark.parametrize(
    "change",
    [
        {"start": [1.0]},
        {"start": [1.0, 1.0, 1.0, 1.0]},
        {"start": "here"},
        {"goal": None},
        {"map": "../../etc/passwd"},
        {"map": "0123456789ABCDEF"},
        {"robot": {"kind": "boat"}},
        {"robot": {"kind": "point", "turning_radius": 1.0}},
        {"robot": {"kind": "dubins", "turning_radius": 0.0}},
        {"robot": {"kind": "point", "radius": -1.0}},
        {"exploration": 1.5},
        {"threshold": -0.1},
        {"time_limit": 0.0},
        {"max_vertices": 0},
        {"seed": 2**32},
        {"speed": 1.0},
        {"time_limit": "1"},
        {"exploration": True},
    ],
)
def test_a_malformed_request_names_the_field(client, problem, change):
    body = expect(client.post("/plan", json=problem | change), 422, "MalformedRequest")
    assert next(iter(change)) in body["message"]


@pytest.mark.parametrize("number", ["NaN", "Infinity", "-Infinity", "1e999", "9" * 5000])
def test_a_number_that_is_none_is_refused(client, problem, number):
    text = json.dumps(problem).replace("-1.2", number)
    headers = {"Content-Type": "application/json"}
    response = client.post("/plan", content=text, headers=headers)
    assert response.status_code in (400, 422)
    assert response.json()["error"] == "MalformedRequest"


@pytest.mark.parametrize("text", ["", "{", "[" * 100_000, '"x"', "\x00", "null"])
def test_what_is_no_request_is_refused(client, text):
    response = client.post("/plan", content=text, headers={"Content-Type": "application/json"})
    assert response.status_code in (400, 422)
    assert response.json()["error"] == "MalformedRequest"


def test_a_body_without_the_type_of_json_is_refused(client, problem):
    # A page of another site can send such a body without asking.
    response = client.post(
        "/plan", content=json.dumps(problem), headers={"Content-Type": "text/plain"}
    )
    expect(response, 422, "MalformedRequest")


def test_a_map_that_is_not_here_is_not_found(client, problem):
    expect(client.post("/plan", json=problem | {"map": ABSENT}), 404, "UnknownMap")
    expect(client.get(f"/maps/{ABSENT}"), 404, "UnknownMap")
    expect(client.get(f"/maps/{ABSENT}/image"), 404, "UnknownMap")
    expect(client.delete(f"/maps/{ABSENT}"), 404, "UnknownMap")


@pytest.mark.parametrize("map_id", ["..", "..%2f..%2fetc%2fpasswd", "x" * 16, "%00", "a" * 10_000])
def test_an_id_that_cannot_be_one_reaches_no_file(client, map_id):
    assert client.get(f"/maps/{map_id}/image").status_code in (404, 422)


def test_unknown_routes_and_methods_have_the_same_body(client):
    expect(client.get("/nowhere"), 404, "NotFound")
    expect(client.put("/plan"), 405, "MethodNotAllowed")


def test_too_many_runs_are_refused(client, problem):
    ends = {key: problem[key] for key in ("map", "start", "goal")}
    body = expect(client.post("/compare", json={**ends, "runs": [{}] * 5}), 400, "InvalidParameter")
    assert "at most 4" in body["message"]
    expect(client.post("/compare", json={**ends, "runs": []}), 422, "MalformedRequest")


def test_an_error_in_one_run_is_the_comparison_s(client, problem):
    ends = {key: problem[key] for key in ("map", "start", "goal")}
    runs = [{"time_limit": 0.1}, {"planner": "Teleport"}]
    expect(client.post("/compare", json={**ends, "runs": runs}), 400, "UnknownPlanner")


@pytest.mark.parametrize("headers", [{"Host": "evil.example"}, {"Origin": "http://evil.example"}])
def test_other_sites_are_refused(client, headers):
    expect(client.get("/maps", headers=headers), 403, "ForeignOrigin")


def test_pages_of_this_machine_are_not(client):
    assert client.get("/maps", headers={"Origin": "http://localhost:5173"}).status_code == 200
