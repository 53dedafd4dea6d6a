from __future__ import annotations

import io

import numpy as np
import pytest
from PIL import Image

import planformer as pf
from planformer.serve.served_map import content_id

MOVINGAI = b"type octile\nheight 3\nwidth 4\nmap\n@@@@\n@..@\n@@@@\n"


def png(occupied):
    """A picture of rows from the top; True is black."""
    buffer = io.BytesIO()
    Image.fromarray(np.where(occupied, 0, 255).astype(np.uint8)).save(buffer, "PNG")
    return buffer.getvalue()


def decoded(response):
    return np.asarray(Image.open(io.BytesIO(response.content)))


def test_a_ros_map_is_the_map_that_the_library_loads(client, room, room_files):
    response = client.post("/maps", files=room_files)
    assert response.status_code == 201
    info = response.json()
    assert info["id"] == content_id(room)
    assert (info["name"], info["rows"], info["columns"]) == ("room", 40, 60)
    assert (info["resolution"], info["origin"]) == (0.05, [-1.5, -1.0, 0.0])
    assert (info["width"], info["height"]) == pytest.approx((3.0, 2.0))
    assert info["occupied"] == pytest.approx(float(room.occupied.mean()))
    assert info["source"] is None
    assert client.get(f"/maps/{info['id']}").json() == info
    assert info in client.get("/maps").json()


def test_the_same_content_is_the_same_map(client, room_files, room_id):
    assert client.post("/maps", files=room_files).json()["id"] == room_id
    assert sum(info["id"] == room_id for info in client.get("/maps").json()) == 1


def test_a_picture_has_the_resolution_of_the_form(client):
    occupied = np.eye(5, 7, dtype=bool)
    files = {"files": ("C:\\maps\\lab.png", png(occupied))}
    info = client.post("/maps", files=files, data={"resolution": "0.1"}).json()
    assert (info["name"], info["rows"], info["columns"]) == ("lab", 5, 7)
    assert info["resolution"] == 0.1
    assert info["id"] == content_id(pf.OccupancyGrid(occupied[::-1], 0.1))


def test_a_movingai_map_is_read(client):
    info = client.post("/maps", files={"files": ("arena.map", MOVINGAI)}).json()
    assert (info["rows"], info["columns"], info["occupied"]) == (3, 4, pytest.approx(10 / 12))


@pytest.mark.parametrize("kind", ["forest", "maze", "indoor"])
def test_a_generated_map_is_the_library_s_and_says_how_it_was_made(client, kind):
    size = {"width": 8.0, "height": 7.0}
    response = client.post("/maps/generate", json={"kind": kind, "seed": 3, **size})
    assert response.status_code == 201
    info = response.json()
    assert info["id"] == content_id(getattr(pf, f"generate_{kind}")(3, **size))
    assert info["source"] == {"kind": kind, "seed": 3, "resolution": 0.05, **size}
    again = client.post("/maps/generate", json=info["source"]).json()
    assert again["id"] == info["id"]


def test_a_map_s_picture_shows_occupied_free_and_unknown_cells(client):
    made = client.post("/maps/generate", json={"kind": "indoor", "seed": 1, "width": 9}).json()
    grid = pf.generate_indoor(1, width=9)
    response = client.get(f"/maps/{made['id']}/image")
    assert response.headers["content-type"] == "image/png"
    levels = decoded(response)[::-1]
    assert np.array_equal(levels == 127, grid.unknown)
    assert np.array_equal(levels == 255, grid.free)
    assert grid.unknown.any()


def test_a_picture_is_sent_once(client, room_id):
    first = client.get(f"/maps/{room_id}/image")
    assert "immutable" in first.headers["cache-control"]
    again = client.get(f"/maps/{room_id}/image", headers={"If-None-Match": first.headers["etag"]})
    assert (again.status_code, again.content) == (304, b"")


def test_a_stroke_occupies_and_another_frees(client, room, room_id):
    wall = {"points": [[0.5, -0.9], [0.5, 0.9]], "radius": 0.1, "occupied": True}
    drawn = client.post(f"/maps/{room_id}/edit", json={"strokes": [wall]})
    assert drawn.status_code == 201
    x, y = room.to_xy(np.stack(np.indices(room.shape), axis=-1)).transpose(2, 0, 1)
    along = np.clip(y, -0.9, 0.9)
    expected = room.occupied | (np.hypot(x - 0.5, y - along) <= 0.1)
    assert drawn.json()["id"] == content_id(pf.OccupancyGrid(expected, 0.05, room.origin))
    wide = {"points": [[0.0, 0.0]], "radius": 50.0, "occupied": False}
    cleared = client.post(f"/maps/{drawn.json()['id']}/edit", json={"strokes": [wide]}).json()
    assert cleared["occupied"] == 0.0


def test_strokes_are_in_the_world_frame_of_a_turned_map(make_server, tmp_path):
    grid = pf.OccupancyGrid(np.zeros((20, 30), bool), 0.1, origin=(5.0, 2.0, 0.7))
    pf.save_map(grid, tmp_path / "turned.yaml")
    client = make_server(folder=tmp_path)
    turned = client.get("/maps").json()[0]["id"]
    point = grid.to_xy((4, 11)).tolist()
    stroke = {"points": [point], "radius": 0.05, "occupied": True}
    edited = client.post(f"/maps/{turned}/edit", json={"strokes": [stroke]}).json()
    levels = decoded(client.get(f"/maps/{edited['id']}/image"))[::-1]
    assert np.argwhere(levels == 0).tolist() == [[4, 11]]


def test_a_deleted_map_is_gone(client, room_files):
    made = client.post("/maps/generate", json={"kind": "forest", "seed": 99, "width": 5}).json()
    assert client.delete(f"/maps/{made['id']}").status_code == 204
    for response in (client.get(f"/maps/{made['id']}"), client.delete(f"/maps/{made['id']}")):
        assert response.status_code == 404
        assert response.json()["error"] == "UnknownMap"


def test_the_least_recently_used_map_gives_way(make_server):
    client = make_server(map_cells=10_000, cells_in_memory=25_000)

    def make(seed):
        size = {"width": 5.0, "height": 5.0}
        return client.post("/maps/generate", json={"kind": "forest", "seed": seed, **size}).json()

    first, second = make(1), make(2)
    client.get(f"/maps/{first['id']}")
    third = make(3)
    assert [info["id"] for info in client.get("/maps").json()] == [first["id"], third["id"]]
    assert client.get(f"/maps/{second['id']}").status_code == 404
    assert make(2)["id"] == second["id"]


def test_uploads_outlive_the_server_in_a_folder_and_generated_maps_do_not(
    make_server, room_files, tmp_path
):
    folder = tmp_path / "maps"
    first = make_server(folder=folder)
    info = first.post("/maps", files=room_files).json()
    first.post("/maps/generate", json={"kind": "forest"})
    second = make_server(folder=folder)
    assert second.get("/maps").json() == [info]
    image = f"/maps/{info['id']}/image"
    assert second.get(image).content == first.get(image).content
    assert second.delete(f"/maps/{info['id']}").status_code == 204
    assert list(folder.iterdir()) == []


def test_a_folder_s_own_maps_are_offered_and_not_deleted(make_server, room, tmp_path):
    pf.save_map(room, tmp_path / "depot.yaml")
    (tmp_path / "arena.map").write_bytes(MOVINGAI)
    (tmp_path / "broken.png").write_bytes(b"no picture")
    (tmp_path / "depot.json").write_text('{"name": "of something else"}')
    before = {path.name for path in tmp_path.iterdir()}
    client = make_server(folder=tmp_path)
    maps = {info["name"]: info["id"] for info in client.get("/maps").json()}
    assert set(maps) == {"depot", "arena"}
    refused = client.delete(f"/maps/{maps['depot']}")
    assert (refused.status_code, refused.json()["error"]) == (403, "RequestRefused")
    assert {path.name for path in tmp_path.iterdir()} == before


def test_a_file_that_has_changed_is_no_longer_the_map(make_server, room, tmp_path):
    (tmp_path / "arena.map").write_bytes(MOVINGAI)
    client = make_server(folder=tmp_path)
    arena = client.get("/maps").json()[0]["id"]
    (tmp_path / "arena.map").write_bytes(MOVINGAI.replace(b"..", b".@"))
    assert client.get(f"/maps/{arena}").json()["error"] == "UnknownMap"


def test_a_folder_that_cannot_be_written_to_takes_no_map(make_server, room_files, tmp_path):
    folder = tmp_path / "maps"
    client = make_server(folder=folder)
    folder.rmdir()
    refused = client.post("/maps", files=room_files)
    assert (refused.status_code, refused.json()["error"]) == (507, "StoreFull")
    folder.mkdir()
    assert client.post("/maps", files=room_files).status_code in (200, 201)


def test_a_full_folder_takes_no_more(make_server, room_files, tmp_path):
    folder = tmp_path / "maps"
    folder.mkdir()
    (folder / "arena.map").write_bytes(MOVINGAI)
    client = make_server(folder=folder, maps=1)
    full = client.post("/maps", files=room_files)
    assert (full.status_code, full.json()["error"]) == (507, "StoreFull")


def test_a_file_that_somebody_removed_is_no_map_any_more(make_server, tmp_path):
    (tmp_path / "hall.map").write_bytes(MOVINGAI)
    client = make_server(folder=tmp_path)
    arena = client.get("/maps").json()[0]["id"]
    (tmp_path / "hall.map").unlink()
    assert client.delete(f"/maps/{arena}").status_code == 404
    assert client.get("/maps").json() == []
    again = client.post("/maps", files={"files": ("arena.map", MOVINGAI)})
    assert again.json()["id"] == arena
    assert (tmp_path / f"{arena}.yaml").is_file()
