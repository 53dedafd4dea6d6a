from __future__ import annotations

import numpy as np
import pytest

from planformer.errors import InvalidResults
from planformer.plotting import plot_letter_values, plot_solved, save_picture
from planformer.plotting.outcomes import Outcomes
from planformer.plotting.statistics import shares_solved

LIMIT = 2.0


def outcomes(name="RRT*", seconds=(0.1, 0.2, 0.4), vertices=(10, 20, 30), failed=()):
    solved = np.array([i not in failed for i in range(len(seconds))], bool)
    counted = np.where(solved, np.array(seconds, float), LIMIT)
    return Outcomes(name, "#0173b2", "--", counted, np.array(vertices, float), solved)


@pytest.fixture
def systems():
    rng = np.random.default_rng(0)
    seconds, vertices = rng.lognormal(-2.0, 1.0, 40), rng.integers(2, 5000, 40)
    return [
        outcomes("RRT*", seconds, vertices, failed=(1, 5)),
        outcomes("MPT-RRT*", seconds, vertices, failed=range(40)),
        outcomes("A*", seconds, [0] * 40),
    ]


def test_letter_values_show_every_system_and_count_failures(systems, tmp_path):
    figure = plot_letter_values(systems, LIMIT, "a title")
    time, vertices = figure.axes
    assert [text.get_text() for text in time.get_yticklabels()] == ["RRT*", "MPT-RRT*", "A*"]
    notes = [text.get_text() for text in time.texts]
    assert notes == ["2 failed", "40 failed", "limit 2 s"]
    assert [text.get_text() for text in vertices.texts] == ["no tree"]
    assert {time.get_xscale(), vertices.get_xscale()} == {"log"}
    assert time.get_xlabel().endswith("[s]")
    low, high = time.get_ylim()
    assert low > 2 > 0 > high  # the first system on top
    for suffix in ("png", "svg"):
        save_picture(figure, tmp_path / f"figure.{suffix}")


def test_failures_lie_at_the_limit(systems):
    time, _ = plot_letter_values(systems[1:2], LIMIT, "").axes
    drawn = np.concatenate([np.ravel(line.get_xdata()) for line in time.lines])
    np.testing.assert_allclose(drawn, LIMIT)


def test_a_run_without_a_vertex_can_be_drawn_on_a_log_scale():
    figure = plot_letter_values([outcomes(vertices=(0, 5, 9), failed=(0,))], LIMIT, "")
    assert figure.axes[1].get_xlim()[0] > 0


def test_curves_end_at_the_share_that_is_solved(systems):
    figure = plot_solved(systems, LIMIT, "a title")
    (axes,) = figure.axes
    assert len(axes.lines) == len(systems)
    labels = [text.get_text() for text in figure.legends[0].get_texts()]
    assert labels[:2] == ["RRT*  95.0%", "MPT-RRT*  0.0%"]
    for line, system in zip(axes.lines, systems, strict=True):
        shares = line.get_ydata()
        assert shares[-1] == np.mean(system.solved)
        assert (np.diff(shares) >= 0).all()
        assert line.get_linestyle() == "--"
    assert axes.get_xlim()[1] == LIMIT


def test_curves_reach_problems_that_took_longer_than_the_limit_with_their_proposal():
    late = outcomes(seconds=(0.1, LIMIT + 0.5), vertices=(9, 9))
    (axes,) = plot_solved([late], LIMIT, "").axes
    assert axes.get_xlim()[1] == pytest.approx(LIMIT + 0.5)
    assert axes.lines[0].get_ydata()[-1] == 1.0


def test_a_problem_counts_from_its_time_on():
    shares = shares_solved(outcomes(failed=(1,)), np.array([0.09, 0.1, 0.3, 0.4, LIMIT]))
    np.testing.assert_allclose(shares, [0, 1 / 3, 1 / 3, 2 / 3, 2 / 3])


@pytest.mark.parametrize("plot", [plot_letter_values, plot_solved])
@pytest.mark.parametrize("nothing", [[], [outcomes(seconds=(), vertices=())]])
def test_without_results_there_is_no_figure(plot, nothing):
    with pytest.raises(InvalidResults, match="no results to draw"):
        plot(nothing, LIMIT, "")
