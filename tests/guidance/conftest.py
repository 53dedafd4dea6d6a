from __future__ import annotations

import hashlib
import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import onnx
import pytest
from onnx import TensorProto, helper

import planformer as pf
from planformer.encoding import NetworkScale, QueryKind
from planformer.planning import Problem

SCALE = NetworkScale()


@pytest.fixture(scope="session")
def room() -> Problem:
    """Two rooms of a 6 m x 4 m map, joined by a door at the top."""
    occupied = np.zeros((80, 120), bool)
    occupied[:60, 58:62] = True
    grid = pf.OccupancyGrid(occupied, 0.05, origin=(-2.0, 1.0, 0.4))
    start, goal = grid.frame.to_world([[1.0, 1.0], [5.0, 1.0]])
    return Problem(grid, pf.PointRobot(), tuple(start), tuple(goal))


@pytest.fixture
def make_weights(tmp_path: Path) -> Callable[..., Path]:
    """Writes a network that predicts a constant, as a real .onnx file with its card."""

    def make(value: float = 0.8, *, headings: bool = False, name: str = "constant") -> Path:
        scale = NetworkScale(query=QueryKind.MARKERS, headings=headings)
        path = tmp_path / f"{name}.onnx"
        content = _constant_network(value, scale).SerializeToString()
        path.write_bytes(content)
        card = {
            "version": 1,
            "name": name,
            "sha256": hashlib.sha256(content).hexdigest(),
            "scale": scale.to_dict(),
        }
        path.with_suffix(".json").write_text(json.dumps(card))
        return path

    return make


def _constant_network(value: float, scale: NetworkScale) -> onnx.ModelProto:
    """A token for every square of stride pixels: 0 * pooled map + value."""
    s = scale.stride
    inputs = [
        helper.make_tensor_value_info("map", TensorProto.UINT8, ["B", 1, "H", "W"]),
        helper.make_tensor_value_info(
            "query", TensorProto.FLOAT, ["B", scale.query_channels, "h", "w"]
        ),
    ]
    nodes = [
        helper.make_node("Cast", ["map"], ["floats"], to=TensorProto.FLOAT),
        helper.make_node("AveragePool", ["floats"], ["pool"], kernel_shape=[s, s], strides=[s, s]),
        helper.make_node("Mul", ["pool", "zero"], ["zeros"]),
        helper.make_node("Add", ["zeros", "value"], ["probability"]),
    ]
    outputs = [helper.make_tensor_value_info("probability", TensorProto.FLOAT, None)]
    if scale.headings:  # a constant heading of pi / 2
        nodes += [
            helper.make_node("Add", ["zeros", "one"], ["ones"]),
            helper.make_node("Concat", ["zeros", "ones"], ["heading"], axis=1),
        ]
        outputs.append(helper.make_tensor_value_info("heading", TensorProto.FLOAT, None))
    constants = {"zero": 0.0, "one": 1.0, "value": value}
    graph = helper.make_graph(
        nodes,
        "constant",
        inputs,
        outputs,
        [helper.make_tensor(key, TensorProto.FLOAT, [], [v]) for key, v in constants.items()],
    )
    return helper.make_model(graph, opset_imports=[helper.make_opsetid("", 17)], ir_version=9)
