from __future__ import annotations

from pathlib import Path

import nbformat
import pytest
from nbclient import NotebookClient

EXAMPLES = sorted((Path(__file__).parents[1] / "examples").glob("*.ipynb"))


@pytest.fixture(scope="module", params=EXAMPLES, ids=lambda path: path.stem)
def cells(request, tmp_path_factory):
    """The code cells of a notebook after they have run; an error in one of them is raised."""
    notebook = nbformat.read(request.param, as_version=4)
    folder = {"metadata": {"path": tmp_path_factory.mktemp("notebook")}}
    NotebookClient(notebook, timeout=300, resources=folder).execute()
    return [cell for cell in notebook.cells if cell.cell_type == "code"]


def shown(cell):
    """The kinds of what a cell shows, besides text."""
    kinds = {kind for output in cell.outputs for kind in output.get("data", {})}
    return kinds - {"text/plain"}


def test_each_cell_tells_something_and_warns_of_nothing(cells):
    for cell in cells:
        assert cell.outputs, f"nothing is seen of {cell.source}"
        assert all(output.get("name") != "stderr" for output in cell.outputs), cell.outputs


@pytest.mark.parametrize("cells", [path for path in EXAMPLES if path.stem == "tour"], indirect=True)
def test_the_tour_shows_maps_regions_plans_and_figures(cells):
    assert [shown(cell) for cell in cells[:3]] == [{"text/html"}] * 3
    assert {"image/png"} in [shown(cell) for cell in cells]
    printed = "".join(output.get("text", "") for cell in cells for output in cell.outputs)
    assert "not found" not in printed
    assert "inf m" not in printed
    assert "the nearest free point is" in printed


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_notebooks_are_kept_without_what_they_showed(path):
    """With their pictures, each change of a notebook would weigh a megabyte."""
    for cell in nbformat.read(path, as_version=4).cells:
        assert not cell.get("outputs")
        assert not cell.metadata
