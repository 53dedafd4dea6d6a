from __future__ import annotations

import pytest

from planformer.errors import InvalidParameter
from planformer.plotting import plot_training, save_picture

HEADER = (
    "step,seconds,learning_rate,train_loss,kind,problems,loss,precision,recall,connected,region"
)


def _log(path, *rows):
    path.write_text("\n".join((HEADER, *rows)) + "\n")
    return path


def test_every_kind_has_a_line_in_every_panel(tmp_path):
    rows = [
        f"{step},1,0.001,{1 / step},{kind},10,{1 / step},0.5,0.75,0.9,0.1"
        for step in (1, 5)
        for kind in ("all", "forest", "maze")
    ]
    figure = plot_training(_log(tmp_path / "log.csv", *rows))
    for axes in figure.axes:
        lines = {line.get_label(): line for line in axes.lines}
        assert {"all", "forest", "maze"} <= set(lines)
        assert list(lines["maze"].get_xdata()) == [1, 5]
    connected = {line.get_label(): line for line in figure.axes[1].lines}["forest"]
    assert list(connected.get_ydata()) == [90, 90]
    save_picture(figure, tmp_path / "curve.svg")


@pytest.mark.parametrize(("loss", "scale"), [(0.3, "log"), (-0.3, "linear")])
def test_negative_losses_can_be_drawn(tmp_path, loss, scale):
    rows = [f"{step},1,0.1,0.5,all,1,{loss},1,1,1,1" for step in (1, 2)]
    figure = plot_training(_log(tmp_path / "log.csv", *rows))
    assert figure.axes[0].get_yscale() == scale
    save_picture(figure, tmp_path / "curve.png")


def test_one_validation_without_positive_anchors_can_be_drawn(tmp_path):
    log = _log(tmp_path / "log.csv", "1,1,0.1,nan,all,1,nan,0,0,0,0")
    save_picture(plot_training(log), tmp_path / "curve.png")


@pytest.mark.parametrize(
    "rows", [[], ["1,1,0.1,0.2,forest,1,1,1,1,1,1"], ["1,1,0.1,0.2,all,1,x,1,1,1,1"], ["1,1"]]
)
def test_refuses_what_is_no_log(tmp_path, rows):
    with pytest.raises(InvalidParameter):
        plot_training(_log(tmp_path / "log.csv", *rows))


def test_refuses_other_files(tmp_path):
    (tmp_path / "log.csv").write_bytes(b"\xff\xfe\x00")
    for file in ("log.csv", "missing.csv"):
        with pytest.raises(InvalidParameter, match=file):
            plot_training(tmp_path / file)
