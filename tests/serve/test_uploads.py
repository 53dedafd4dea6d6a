"""Uploads that mean harm, or are merely damaged."""

from __future__ import annotations

import contextlib
import gzip
import io
import struct
import tracemalloc
import zipfile
import zlib

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from PIL import Image

from planformer.errors import InvalidMap, PlanformerError, TooLarge
from planformer.maps.io import load_map
from planformer.serve.uploads import base_name, read_upload

from .test_errors import expect
from .test_maps import MOVINGAI, png

CELLS = 1_000_000
SMALL = png(np.eye(8, dtype=bool))
YAML = (
    b"image: {image}\nresolution: 0.05\norigin: [0, 0, 0]\n"
    b"negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"
)


def described(image="lab.png"):
    return YAML.replace(b"{image}", image.encode())


def read(files):
    return read_upload(files, resolution=None, map_cells=CELLS)


def huge_png(width, height):
    """A PNG of a few bytes that claims to be huge and black."""

    def chunk(kind, data):
        checksum = zlib.crc32(kind + data)
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", checksum)

    header = struct.pack(">2I5B", width, height, 8, 0, 0, 0, 0)
    pixels = zlib.compress(bytes(10_000_000), 9)
    return (
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", pixels) + chunk(b"IEND", b"")
    )


@pytest.mark.parametrize("size", [(1001, 1000), (20_000, 20_000), (2**31 - 1, 2**31 - 1)])
def test_a_decompression_bomb_is_refused_from_its_header(size):
    data = huge_png(*size)
    tracemalloc.start()
    with pytest.raises((InvalidMap, TooLarge), match=r"pixels|too large|decoded"):
        read({"bomb.png": data})
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 1_000_000


@pytest.mark.parametrize(
    "header", [b"P5\n99999 99999\n255\n", b"P2\n99999 99999\n255\n", b"P5\n-1 5\n"]
)
def test_a_pgm_that_claims_too_much_is_refused(header):
    with pytest.raises((InvalidMap, TooLarge)):
        read({"bomb.pgm": header + bytes(100)})


@pytest.mark.parametrize(
    "text",
    [
        b"a: &a [x, x, x, x, x, x, x, x, x]\nb: &b [*a, *a, *a, *a, *a, *a, *a]\norigin: *b\n",
        b"a: &a [*a]\n",
        b"[" * 60_000,
        b"a: " * 20_000,
        b"!!python/object/apply:os.system ['true']\n",
        b"\xff\xfe\x00",
        b"- 1\n",
        b"",
    ],
)
def test_a_yaml_bomb_is_refused(text):
    with pytest.raises(InvalidMap, match=r"\.yaml: ") as caught:
        read({"lab.yaml": described() + text if b"origin" in text else text, "lab.png": SMALL})
    assert len(str(caught.value)) < 1000


def test_a_long_description_is_not_even_parsed():
    with pytest.raises(InvalidMap, match="at most 65536 bytes"):
        read({"lab.yaml": described() + b"#" * 2**16, "lab.png": SMALL})


@pytest.mark.parametrize(
    "image", ["/etc/passwd", "../../secret.png", "other.png", "lab.yaml", ".."]
)
def test_a_description_can_only_name_the_uploaded_picture(tmp_path, image):
    (tmp_path / "secret.png").write_bytes(SMALL)
    with pytest.raises(InvalidMap, match="names the picture"):
        read({"lab.yaml": described(image), "lab.png": SMALL})


@pytest.mark.parametrize("image", ["lab.png", "/home/me/maps/lab.png", "C:\\maps\\lab.png"])
def test_the_picture_s_folder_on_the_uploader_s_disk_does_not_matter(image):
    assert read({"lab.yaml": described(image), "lab.png": SMALL}).grid.shape == (8, 8)


@pytest.mark.parametrize(
    "files",
    [
        {},
        {"lab.yaml": described()},
        {"lab.png": SMALL, "lab2.png": SMALL},
        {"lab.yaml": described(), "lab2.yaml": described()},
        {"": SMALL},
        {"lab": SMALL},
        {"lab.npy": b"\x93NUMPY"},
        {"lab.exe": b"MZ"},
        {"lab.tif": SMALL},
    ],
)
def test_what_is_no_map_is_refused(files):
    with pytest.raises(InvalidMap):
        read(files)


def test_archives_are_refused():
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("lab.png", bytes(10_000_000))
    for name, data in (("m.zip", buffer.getvalue()), ("m.png", buffer.getvalue())):
        with pytest.raises(InvalidMap):
            read({name: data})
    with pytest.raises(InvalidMap):
        read({"m.pgm": gzip.compress(SMALL)})


def test_a_picture_may_only_be_what_its_suffixes_allow():
    from PIL import Image

    buffer = io.BytesIO()
    Image.new("L", (8, 8)).save(buffer, "TIFF")
    with pytest.raises(InvalidMap, match="Pillow"):
        read({"lab.png": buffer.getvalue()})


def test_a_resolution_of_a_ros_map_is_its_own(client, room_files):
    response = client.post("/maps", files=room_files, data={"resolution": "0.1"})
    expect(response, 400, "InvalidParameter")


@pytest.mark.parametrize("resolution", ["0", "-1", "NaN", "inf", "1e999", "five"])
def test_an_impossible_resolution_is_refused(client, resolution):
    files = {"files": ("lab.png", SMALL)}
    response = client.post("/maps", files=files, data={"resolution": resolution})
    expect(response, 422, "MalformedRequest")


def test_too_large_uploads_are_refused_before_they_are_read(make_server):
    client = make_server(upload_bytes=100_000, body_bytes=10_000, map_cells=64)
    refused = client.post("/maps", files={"files": ("a.png", bytes(150_000))})
    assert "100,000 bytes" in expect(refused, 413, "TooLarge")["message"]
    refused = client.post("/maps", files={"files": ("a.png", bytes(5_000_000))})
    expect(refused, 413, "TooLarge")

    def chunks():  # without a length
        yield from (b"x" * 10_000 for _ in range(3))

    expect(client.post("/plan", content=chunks()), 413, "TooLarge")
    assert client.post("/maps", files={"files": ("a.png", SMALL)}).status_code == 201


def test_too_many_cells_are_refused(make_server):
    client = make_server(map_cells=11)
    expect(client.post("/maps", files={"files": ("a.png", SMALL)}), 413, "TooLarge")
    expect(client.post("/maps", files={"files": ("a.map", MOVINGAI)}), 413, "TooLarge")
    expect(client.post("/maps/generate", json={"kind": "forest"}), 413, "TooLarge")
    endless = {"kind": "forest", "width": 500.0, "height": 500.0, "resolution": 1e-300}
    expect(client.post("/maps/generate", json=endless), 413, "TooLarge")


def test_two_files_of_one_name_are_refused(client):
    for names in (("a.png", "a.png"), ("x/a.png", "y/a.png")):
        files = [("files", (name, SMALL)) for name in names]
        refused = expect(client.post("/maps", files=files), 400, "InvalidMap")
        assert "same name" in refused["message"]


def test_too_much_drawing_is_refused(make_server, room_files):
    client = make_server(stroke_points=10)
    room = client.post("/maps", files=room_files).json()["id"]

    def draw(points, radius=0.1):
        stroke = {"points": points, "radius": radius, "occupied": True}
        return client.post(f"/maps/{room}/edit", json={"strokes": [stroke]})

    expect(draw([[0.0, 0.0]] * 11), 413, "TooLarge")
    expect(draw([[1e300, 0.0]]), 400, "InvalidParameter")
    assert draw([[0.0, 0.0]], radius=1e300).json()["occupied"] == 1.0


@pytest.mark.parametrize(
    ("sent", "name"),
    [
        ("lab.png", "lab.png"),
        ("/etc/lab.png", "lab.png"),
        ("..\\..\\lab.png", "lab.png"),
        ("C:lab.png", "lab.png"),
        ("..", ".."),
    ],
)
def test_names_lose_their_folders(sent, name):
    assert base_name(sent) == name


def test_a_name_is_only_shown(make_server, tmp_path):
    client = make_server(folder=tmp_path / "maps")
    files = {"files": ("../../<b>\x00evil\n.png", SMALL)}
    info = client.post("/maps", files=files).json()
    assert "\n" not in info["name"]
    written = sorted(path.name for path in (tmp_path / "maps").iterdir())
    assert written == [f"{info['id']}{suffix}" for suffix in (".json", ".pgm", ".yaml")]


def test_nothing_outside_the_folder_is_offered(make_server, tmp_path):
    (tmp_path / "secret.png").write_bytes(SMALL)
    folder = tmp_path / "maps"
    folder.mkdir()
    (folder / "link.png").symlink_to(tmp_path / "secret.png")
    (folder / "far.yaml").write_bytes(described("../secret.png"))
    assert make_server(folder=folder).get("/maps").json() == []


@settings(max_examples=300, suppress_health_check=[HealthCheck.too_slow])
@given(st.data())
def test_damaged_files_give_typed_errors_or_maps(data):
    name, whole = data.draw(st.sampled_from([("a.png", SMALL), ("a.map", MOVINGAI)]))
    content = bytearray(whole)
    for _ in range(data.draw(st.integers(1, 6))):
        content[data.draw(st.integers(0, len(content) - 1))] = data.draw(st.integers(0, 255))
    cut = data.draw(st.integers(0, len(content)))
    with contextlib.suppress(PlanformerError):
        served = read({name: bytes(content[: cut or None])})
        assert served.grid.occupied.size <= CELLS


def test_the_library_refuses_aliases_too(tmp_path):
    (tmp_path / "a.yaml").write_bytes(described() + b"a: &a 1\nb: *a\n")
    (tmp_path / "lab.png").write_bytes(SMALL)
    with pytest.raises(InvalidMap, match="aliases"):
        load_map(tmp_path / "a.yaml")


def test_a_jpeg_of_very_many_scans_is_refused_undecoded():
    picture = io.BytesIO()
    Image.fromarray(np.full((64, 64), 255, np.uint8)).save(picture, "JPEG", progressive=True)
    data = picture.getvalue()
    assert read({"map.jpg": data}).grid.shape == (64, 64)
    scan = data[data.rindex(b"\xff\xda") : -2]
    with pytest.raises(InvalidMap, match="scans"):
        read({"map.jpg": data[:-2] + 200 * scan + data[-2:]})


def test_a_map_that_is_a_line_of_very_many_cells_is_refused(client):
    line = b"type octile\nheight 1\nwidth 100000\nmap\n" + b"." * 100_000 + b"\n"
    response = client.post("/maps", files=[("files", ("line.map", line))])
    assert "65,535" in expect(response, 413, "TooLarge")["message"]
