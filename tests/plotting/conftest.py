from __future__ import annotations

import numpy as np
import pytest

import planformer as pf
from planformer.planning import Tree
from planformer.plotting.style import rgb


def _make_region(problem, probability, threshold=0.5):
    """A region with anchors evenly spread over a map, each with a patch of its own."""
    grid = problem.grid
    rows, columns = probability.shape
    x = (np.arange(columns) + 0.5) * grid.width / columns
    y = (np.arange(rows) + 0.5) * grid.height / rows
    local = np.stack(np.meshgrid(x, y), axis=-1)
    at_row = np.arange(grid.shape[0]) * rows // grid.shape[0]
    at_column = np.arange(grid.shape[1]) * columns // grid.shape[1]
    return pf.Region(
        problem=problem,
        probability=probability.astype(np.float32),
        anchors=grid.frame.to_world(local),
        threshold=threshold,
        mask=(probability >= threshold)[np.ix_(at_row, at_column)],
        connected=True,
        patch=grid.width / columns,
        headings=None,
    )


def _make_result(problem, path, *, region=None, tree=None, solved=True):
    return pf.PlanResult(
        problem=problem,
        solved=solved,
        status=pf.PlanStatus.FINISHED if solved else pf.PlanStatus.TIME_LIMIT,
        path=np.asarray(path, float),
        length=1.0 if solved else np.inf,
        vertices=2,
        planning_seconds=0.1,
        proposal_seconds=0.01,
        region=region,
        tree=tree,
    )


class Picture:
    """A drawn figure, asked for the colours at world points."""

    def __init__(self, figure):
        from matplotlib.backends.backend_agg import FigureCanvasAgg

        canvas = FigureCanvasAgg(figure)
        canvas.draw()
        self.axes = figure.axes[0]
        self.pixels = np.asarray(canvas.buffer_rgba())[..., :3] / 255.0

    def at(self, xy):
        column, row = np.ravel(self.axes.transData.transform(xy))
        return self.pixels[int(len(self.pixels) - row), int(column)]

    def shows(self, xy, colour):
        return np.abs(self.at(xy) - rgb(colour)).max() < 0.02


@pytest.fixture
def draw():
    def run(*args, **options):
        from planformer.plotting import plot_result

        return Picture(plot_result(*args, **options))

    return run


@pytest.fixture
def tree_of():
    def run(states):
        count = len(states)
        edges = np.column_stack((np.arange(count - 1), np.arange(1, count)))
        return Tree(np.asarray(states, float), edges)

    return run


@pytest.fixture
def make_region():
    return _make_region


@pytest.fixture
def make_result():
    return _make_result
