from __future__ import annotations

import json
import time

import numpy as np
import pytest

import planformer as pf
from planformer.planning import Tree, edge_lines
from planformer.serve.answers import tree_answer
from planformer.serve.tree_updates import TreeUpdates

from .test_errors import expect

RUNNING = "planformer_plans_running "


def events_of(client, body):
    """The events of a stream as (name, data)."""
    with client.stream("POST", "/plan/stream", json=body) as response:
        assert response.status_code == 200
        assert response.headers["content-type"].startswith("text/event-stream")
        blocks = "".join(response.iter_text()).strip().split("\n\n")
    lines = [block.split("\n") for block in blocks if not block.startswith(":")]
    assert all(name.startswith("event: ") and data.startswith("data: ") for name, data in lines)
    return [(name[7:], json.loads(data[6:])) for name, data in lines]


def applied(tree, update):
    """The tree as a client has it after an update: vertices, parents, links."""
    vertices, parents, _ = tree
    vertices = vertices[: update["first"]] + np.reshape(update["vertices"], (-1, 2)).tolist()
    parents = parents[: update["first"]] + update["parents"]
    for vertex, parent in np.reshape(update["changed"], (-1, 2)).astype(int):
        parents[vertex] = int(parent)
    return vertices, parents, update["links"]


def test_a_stream_ends_with_the_result_of_plan(client, problem):
    problem |= {"max_vertices": 400}
    events = events_of(client, problem)
    name, result = events[-1]
    assert name == "result"
    alone = client.post("/plan", json=problem).json()
    assert result["path"] == alone["path"]
    assert {name for name, _ in events[:-1]} <= {"progress"}


def test_region_progress_and_result_come_in_this_order(client, room, problem):
    problem |= {"guide": "auto", "region": True, "tree": True, "time_limit": 1.0}
    events = events_of(client, problem)
    names = [name for name, _ in events]
    assert names[0] == "region"
    assert names[-1] == "result"
    assert set(names[1:-1]) == {"progress"}
    assert len(names) >= 6
    assert events[0][1] | {"proposal_seconds": 0.0} == (
        events[-1][1]["region"] | {"proposal_seconds": 0.0}
    )
    progress = [data for name, data in events if name == "progress"]
    seconds = [data["seconds"] for data in progress]
    assert seconds == sorted(seconds)
    lengths = [data["length"] for data in progress if data["length"] is not None]
    assert lengths == sorted(lengths, reverse=True)
    assert lengths[-1] >= events[-1][1]["length"] - 1e-9
    paths = [data["path"] for data in progress if data["path"]]
    assert 0 < len(paths) <= len(lengths)
    assert all(pf.path_is_valid(room, pf.PointRobot(0.1), np.array(path)) for path in paths)


@pytest.mark.parametrize("planner", ["RRTstar", "BITstar", "PRMstar"])
def test_tree_updates_add_up_to_a_tree_on_free_cells(client, room, problem, planner):
    problem |= {"planner": planner, "tree": True, "time_limit": 1.0}
    tree, firsts = ([], [], []), []
    for name, data in events_of(client, problem):
        if name == "progress" and data["tree"] is not None:
            tree = applied(tree, data["tree"])
            firsts.append(data["tree"]["first"])
            assert len(tree[0]) == len(tree[1])
            assert max(tree[1]) < len(tree[0])
            assert max(tree[2], default=-1) < len(tree[0])
    assert firsts[0] == 0
    if planner == "RRTstar":
        assert all(firsts[1:])
    blocked = room.blocked(0.1)
    # Millimetres may round a vertex into the cell beside its own.
    near = [np.add(tree[0], (dx, dy)) for dx in (-6e-4, 6e-4) for dy in (-6e-4, 6e-4)]
    assert not np.all([blocked[tuple(room.to_rc(xy).T)] for xy in near], axis=0).any()


def random_tree(rng, size):
    parents = [int(rng.integers(child)) for child in range(1, size)]
    edges = np.column_stack((parents, np.arange(1, size)))
    return Tree(rng.uniform(0, 10, (size, 2)), edges)


def edges_of(vertices, parents):
    """Edges as pairs of places."""
    places = [tuple(np.round(vertex, 3)) for vertex in vertices]
    return {(places[parent], places[child]) for child, parent in enumerate(parents) if parent >= 0}


def test_updates_follow_growth_new_parents_and_pruning():
    rng = np.random.default_rng(1)
    whole = random_tree(rng, 300)
    updates, client = TreeUpdates(pf.PointRobot()), ([], [], [])
    for size in (1, 50, 50, 120, 300, 200, 300):
        edges = whole.edges[: size - 1].copy()
        rewired = rng.integers(1, max(size, 2), 5)
        for child in rewired[rewired < size]:
            edges[child - 1, 0] = 0
        order = rng.permutation(size)  # planners list their vertices in any order
        place = np.argsort(order)
        shown = Tree(whole.vertices[:size][order], place[edges])
        update = updates.update(shown).model_dump()
        client = applied(client, update)
        parents = np.full(size, -1)
        parents[shown.edges[:, 1]] = shown.edges[:, 0]
        assert edges_of(client[0], client[1]) == edges_of(shown.vertices, parents)
    assert updates.update(shown).model_dump() == {
        "first": 300,
        "vertices": [],
        "parents": [],
        "changed": [],
        "links": [],
        "curves": [],
    }


def test_a_cars_edges_come_with_their_curves():
    rng = np.random.default_rng(2)
    car = pf.DubinsCar(0.1, 0.4)
    tree = random_tree(rng, 60)
    poses = np.column_stack((tree.vertices, rng.uniform(-3, 3, 60)))
    updates, curves = TreeUpdates(car), []
    for size in (20, 60, 60):
        edges = tree.edges[: size - 1].copy()
        if size == 60:
            edges[4, 0] = 0  # has another parent from now on
        update = updates.update(Tree(poses[:size], edges))
        count = len(update.parents)
        curves = curves[: update.first] + update.curves[:count]
        for vertex, curve in zip(update.changed[::2], update.curves[count:], strict=True):
            curves[vertex] = curve
    assert update.curves == []
    lines = dict(zip(edges[:, 1].tolist(), edge_lines(car, poses, edges), strict=True))
    shown = tree_answer(Tree(poses, edges), car)
    assert len(shown.curves) == len(curves) == 60
    assert shown.curves[0] == []
    for vertex, curve in enumerate(shown.curves[1:], start=1):
        np.testing.assert_allclose(np.reshape(curve, (-1, 2)), lines[vertex][1:-1], atol=6e-4)
        assert len(curve) >= 2
    assert sorted(map(tuple, shown.curves)) == sorted(map(tuple, curves))


def test_vertices_in_the_same_place_are_one():
    start, other = (1.0, 1.0), (2.0, 1.0)
    updates = TreeUpdates(pf.PointRobot())
    twice = Tree(np.array([start, start, other]), np.array([[0, 1], [1, 2]]))
    first = updates.update(twice)
    assert len(first.parents) == 2
    assert updates.update(twice).first == 2


def test_errors_before_the_search_are_ordinary_ones(client, problem):
    for change, status, error in (
        ({"start": [0.0, -0.9]}, 400, "StartOccupied"),
        ({"planner": "Teleport"}, 400, "UnknownPlanner"),
        ({"map": "0" * 16}, 404, "UnknownMap"),
        ({"start": []}, 422, "MalformedRequest"),
    ):
        expect(client.post("/plan/stream", json=problem | change), status, error)


def test_a_request_is_refused_however_long_its_check_takes(make_server):
    client = make_server(progress_seconds=1e-4)
    floor_plan = {"kind": "indoor", "width": 80.0, "height": 80.0}
    large = client.post("/maps/generate", json=floor_plan).json()["id"]
    body = {"map": large, "start": [0.02, 0.02], "goal": [30.0, 30.0]}  # the start is in a wall
    expect(client.post("/plan/stream", json=body), 400, "StartOccupied")


def test_planners_without_snapshots_show_that_they_work(client, problem):
    problem |= {"planner": "NEXT-KS", "target_length": 0.01, "time_limit": 0.5}
    with client.stream("POST", "/plan/stream", json=problem) as response:
        blocks = "".join(response.iter_text()).strip().split("\n\n")
    assert blocks[0] == ": at work"
    assert blocks[-1].startswith("event: result")


def test_a_stream_that_is_left_ends_its_search(make_server, problem, room_files):
    client = make_server(plans=1, plan_seconds=600.0)
    client.post("/maps", files=room_files)
    forever = problem | {"time_limit": 600.0}
    with client.stream("POST", "/plan/stream", json=forever) as response:
        texts = response.iter_text()  # kept: its end would close the stream
        next(texts)
        assert running(client) == 1
    deadline = time.monotonic() + 30
    while running(client) and time.monotonic() < deadline:
        time.sleep(0.01)
    assert running(client) == 0


def running(client):
    """How many searches the server runs."""
    lines = client.get("/metrics").text.splitlines()
    return next(float(line.split()[1]) for line in lines if line.startswith(RUNNING))


@pytest.mark.parametrize(
    ("change", "error"),
    [({"guide": "mpt-dubins"}, "WeightsMismatch"), ({"planner": "SST"}, "UnknownPlanner")],
)
def test_what_does_not_fit_the_robot_is_no_stream(make_server, room_files, change, error):
    client = make_server(progress_seconds=1e-4)
    map_id = client.post("/maps", files=room_files).json()["id"]
    request = {"map": map_id, "start": [-1.2, -0.6], "goal": [1.2, -0.6], **change}
    expect(client.post("/plan/stream", json=request), 400, error)
