from __future__ import annotations

import base64
import io
import re

import numpy as np
import pytest
from PIL import Image

import planformer as pf
from planformer.plotting import style

GRID = pf.generate_forest(seed=3, width=12.0, height=8.0)


def parts(shown):
    """The picture and the facts of what a notebook shows."""
    html = shown._repr_html_()
    (data,) = re.findall(r"src='data:image/png;base64,([^']+)'", html)
    facts = re.findall(r"<th[^>]*>([^<]+)</th><td[^>]*>([^<]*)</td>", html)
    return Image.open(io.BytesIO(base64.b64decode(data))).convert("RGB"), dict(facts)


def colours(image):
    return set(map(tuple, np.asarray(image).reshape(-1, 3).tolist()))


def levels(colour):
    return tuple(np.round(255 * style.rgb(colour)).astype(int).tolist())


@pytest.fixture(scope="module")
def result():
    ends = GRID.nearest_free((1.0, 1.0), 0.1), GRID.nearest_free((11.0, 7.0), 0.1)
    return pf.plan(
        GRID, pf.PointRobot(0.1), *ends, max_vertices=300, time_limit=None, seed=1, keep_tree=True
    )


def test_a_map_shows_its_cells_and_says_their_size():
    occupied = np.zeros((20, 40), bool)
    occupied[:5, :10] = True  # below, left
    image, facts = parts(pf.OccupancyGrid(occupied, 0.1, (1.0, 2.0, np.pi / 2)))
    assert image.width == 2 * image.height
    assert image.getpixel((5, image.height - 5)) == levels(style.OBSTACLE)
    assert image.getpixel((5, 5)) == levels(style.FLOOR)
    assert facts["cells"] == "40 x 20"
    assert facts["extent"] == "4 x 2 m"
    assert facts["origin"] == "(1 m, 2 m, 90°)"
    assert facts["occupied"] == "6.2%"


def test_a_region_shows_its_heat_and_its_ends(result):
    image, facts = parts(result.region)
    seen = colours(image)
    assert {levels(style.START), levels(style.GOAL)} <= seen
    assert levels(style.PATH) not in seen
    assert len(seen) > len(colours(parts(GRID)[0]))
    assert facts["connects the ends"] == "yes"
    assert facts["share of the map"] == f"{result.region.share:.1%}"


def test_a_result_shows_its_path(result):
    image, facts = parts(result)
    assert {levels(style.START), levels(style.PATH)} <= colours(image)
    assert facts["outcome"].startswith("path found")
    assert facts["length"] == f"{result.length:.2f} m"
    assert facts["vertices"] == str(result.vertices)


def test_a_result_without_path_region_and_tree_says_so(room):
    blocked = room.occupied.copy()
    blocked[:, 30] = True
    grid = pf.OccupancyGrid(blocked, room.resolution, room.origin)
    result = pf.plan(grid, pf.PointRobot(0.05), (-1.0, 0.0), (1.0, 0.0), guide=None)
    image, facts = parts(result)
    assert levels(style.PATH) not in colours(image)
    assert facts["outcome"] == "no path: unreachable"
    assert facts["length"] == facts["proposal"] == "none"


@pytest.mark.parametrize("shape", [(1, 1), (3, 900), (900, 3)])
def test_maps_of_any_shape_have_a_picture(shape):
    grid = pf.OccupancyGrid(np.zeros(shape, bool), 0.05)
    image, _ = parts(grid)
    assert max(image.size) <= 1200
    start = tuple(grid.to_xy((0, 0)))
    image, _ = parts(pf.plan(grid, pf.PointRobot(0.0), start, start, guide=None))
    assert 50 <= max(image.size) <= 1200


def test_a_plot_is_a_figure_that_a_notebook_shows(result, tmp_path):
    figure = result.plot(title="a plan")
    png, size = figure._repr_png_()
    with Image.open(io.BytesIO(png)) as image:
        assert levels(style.PATH) in colours(image.convert("RGB"))
        assert image.width > size["width"] >= 300
        assert image.width / image.height == pytest.approx(size["width"] / size["height"], rel=0.01)
    figure.savefig(tmp_path / "plan.pdf")
    assert (tmp_path / "plan.pdf").read_bytes().startswith(b"%PDF")
