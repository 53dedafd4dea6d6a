from __future__ import annotations

import base64
import io

import numpy as np
import pytest
from PIL import Image

import planformer as pf
from planformer.planning import search


def test_a_plan_is_the_library_s(client, room, problem):
    problem |= {"max_vertices": 300, "tree": True}
    response = client.post("/plan", json=problem)
    assert response.status_code == 200
    got = response.json()
    robot = pf.PointRobot(0.1)
    start, goal = problem["start"], problem["goal"]
    wanted = pf.plan(room, robot, start, goal, guide=None, max_vertices=300, seed=1, keep_tree=True)
    assert (got["solved"], got["status"]) == (True, wanted.status.value)
    assert np.array_equal(got["path"], wanted.path)
    assert (got["length"], got["vertices"]) == (wanted.length, wanted.vertices)
    assert (got["planner"], got["guide"], got["seed"]) == ("InformedRRTstar", None, 1)
    assert got["total_seconds"] == got["planning_seconds"] + got["proposal_seconds"]
    assert got["region"] is None
    vertices = np.reshape(got["tree"]["vertices"], (-1, 2))
    assert np.abs(vertices - wanted.tree.vertices).max() <= 0.0005 + 1e-9
    edges = {(parent, child) for child, parent in enumerate(got["tree"]["parents"]) if parent >= 0}
    assert edges == set(map(tuple, wanted.tree.edges.tolist()))
    assert got["tree"]["links"] == []


def test_the_region_is_the_library_s(client, room, problem):
    problem |= {"guide": "auto", "region": True, "max_vertices": 50}
    region = client.post("/plan", json=problem).json()["region"]
    wanted = pf.propose_region(room, pf.PointRobot(0.1), problem["start"], problem["goal"])
    assert (region["guide"], region["threshold"]) == ("mpt", wanted.threshold)
    assert (region["rows"], region["columns"]) == wanted.probability.shape
    assert np.allclose(region["probability"], wanted.probability.ravel(), atol=0.0006)
    assert np.allclose(region["anchors"], wanted.anchors.reshape(-1, 2), atol=0.0006)
    mask = np.asarray(Image.open(io.BytesIO(base64.b64decode(region["mask"]))).convert("L"))
    assert np.array_equal(mask[::-1] == 255, wanted.mask)
    asked = {key: problem[key] for key in ("map", "start", "goal")}
    proposed = client.post("/propose", json=asked).json()
    for answer in (region, proposed):
        assert answer.pop("proposal_seconds") > 0.0
    assert proposed == region


def test_a_dense_lattice_of_anchors_is_pooled(client):
    made = client.post("/maps/generate", json={"kind": "forest", "seed": 1}).json()
    ends = {"start": [2.0, 2.0], "goal": [22.0, 22.0], "guide": "unet"}
    region = client.post("/propose", json={"map": made["id"], **ends}).json()
    assert region["rows"] * region["columns"] <= 10_000
    assert len(region["probability"]) == len(region["anchors"])
    steps = np.diff(np.reshape(region["anchors"], (region["rows"], -1, 2))[0, :-1, 0])
    assert np.allclose(steps, region["anchor_size"], atol=0.002)


@pytest.mark.parametrize("kind", ["dubins", "reeds-shepp"])
def test_a_car_s_path_is_valid(client, room, problem, kind):
    problem |= {"robot": {"kind": kind, "radius": 0.1, "turning_radius": 0.3}}
    problem |= {"start": [-1.2, -0.6, 1.57], "goal": [1.2, -0.6, -1.57], "target_length": 8.0}
    got = client.post("/plan", json=problem).json()
    robot = {"dubins": pf.DubinsCar, "reeds-shepp": pf.ReedsSheppCar}[kind](0.1, 0.3)
    assert got["solved"]
    assert pf.path_is_valid(room, robot, np.array(got["path"]))


def test_a_roadmap_has_links_besides_parents(client, room, problem):
    problem |= {"planner": "PRMstar", "max_vertices": 100, "tree": True}
    tree = client.post("/plan", json=problem).json()["tree"]
    drawn = {(parent, child) for child, parent in enumerate(tree["parents"]) if parent >= 0}
    links = set(map(tuple, np.reshape(tree["links"], (-1, 2)).tolist()))
    ends = tuple(problem["start"]), tuple(problem["goal"])
    limits = pf.planning.SearchLimits(None, None, 100)
    wanted = search(
        pf.Problem(room, pf.PointRobot(0.1), *ends),
        "PRMstar",
        limits=limits,
        seed=1,
        keep_tree=True,
    ).tree
    assert links
    assert not links & drawn
    assert links | drawn == set(map(tuple, wanted.edges.tolist()))


def test_a_learned_planner_does_without_a_guide(client, problem):
    got = client.post("/plan", json=problem | {"planner": "MPNet", "guide": "auto"}).json()
    assert (got["guide"], got["region"], got["proposal_seconds"]) == (None, None, 0.0)


def test_a_seed_that_was_drawn_repeats_the_plan(client, problem):
    problem |= {"seed": None, "max_vertices": 200}
    first = client.post("/plan", json=problem).json()
    again = client.post("/plan", json=problem | {"seed": first["seed"]}).json()
    assert again["path"] == first["path"]


def test_no_path_is_an_answer(client, room_id, problem):
    wall = {"points": [[0.0, -1.0], [0.0, 1.0]], "radius": 0.1, "occupied": True}
    split = client.post(f"/maps/{room_id}/edit", json={"strokes": [wall]}).json()["id"]
    got = client.post("/plan", json=problem | {"map": split}).json()
    assert (got["solved"], got["status"]) == (False, "unreachable")
    assert (got["path"], got["length"]) == ([], None)


def test_runs_are_compared_in_their_order(client, problem):
    options = {"guide": None, "max_vertices": 1000, "time_limit": 20.0, "seed": 1}
    planners = ["RRTstar", "BITstar", "RRTConnect"]
    ends = {key: problem[key] for key in ("map", "start", "goal")}
    runs = [{"planner": planner, **options} for planner in planners]
    results = client.post("/compare", json={**ends, "runs": runs}).json()["results"]
    assert [result["planner"] for result in results] == planners
    assert all(result["solved"] for result in results)
    alone = client.post("/plan", json={**ends, **runs[1]}).json()
    assert results[1]["path"] == alone["path"]


def test_options_list_what_plan_takes(client):
    options = client.get("/options").json()
    assert set(options["robots"]) == {"point", "dubins", "reeds-shepp"}
    point, car = options["robots"]["point"], options["robots"]["dubins"]
    assert point["planners"] == pf.planner_names(pf.PointRobot())
    assert car["planners"] == pf.planner_names(pf.DubinsCar())
    assert point["guides"] == ["mpt", "mpt-paper", "mpt-paper-fixed-encoding", "unet"]
    assert "mpt-dubins" in car["guides"]
    assert point["unguided_planners"] == ["MPNet", "NEXT-KS"]
    for robot in (point, car):
        assert robot["default_guide"] in robot["guides"]
        assert robot["default_planner"] in robot["planners"]
    assert options["limits"]["plan_seconds"] == 60.0
