"""Networks that do not do what their cards say, and proposers of one's own."""

from __future__ import annotations

import hashlib
import json
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import onnx
import pytest

import planformer as pf
from planformer.errors import InvalidParameter, InvalidWeights, UnknownGuide, WeightsMismatch
from planformer.guidance import OnnxProposer, load_network, make_region


def replaced(path, change):
    """Change the network in a file, and the checksum in its card."""
    model = onnx.load(path)
    change(model.graph)
    path.write_bytes(model.SerializeToString())
    card = path.with_suffix(".json")
    digest = hashlib.sha256(path.read_bytes()).hexdigest()
    card.write_text(json.dumps({**json.loads(card.read_text()), "sha256": digest}))
    return str(path)


def rename_map(graph):
    graph.input[0].name = "picture"
    graph.node[0].input[0] = "picture"


def want_more_channels(graph):
    graph.input[1].type.tensor_type.shape.dim[1].dim_value += 1


def want_a_third_input(graph):
    extra = graph.input.add()
    extra.CopyFrom(graph.input[1])
    extra.name = "wind"


def pool_twice_as_much(graph):
    for attribute in graph.node[1].attribute:
        attribute.ints[:] = [2 * value for value in attribute.ints]


def predict_another_array(graph):
    extra = graph.output.add()
    extra.CopyFrom(graph.output[0])
    extra.name = "zeros"


@pytest.mark.parametrize(
    "change",
    [rename_map, want_more_channels, want_a_third_input, pool_twice_as_much, predict_another_array],
)
def test_a_network_that_does_not_fit_its_card_is_refused(room, make_weights, change):
    guide = replaced(make_weights(name=change.__name__), change)
    with pytest.raises(WeightsMismatch, match=change.__name__):
        pf.propose_region(room.grid, room.robot, room.start, room.goal, guide=guide)


def test_a_card_that_promises_headings_of_a_network_without_is_refused(room, make_weights):
    path = make_weights()
    card = json.loads(path.with_suffix(".json").read_text())
    card["scale"]["headings"] = True
    path.with_suffix(".json").write_text(json.dumps(card))
    car = pf.DubinsCar(radius=0.1)
    with pytest.raises(WeightsMismatch):
        pf.propose_region(room.grid, car, (*room.start, 0.0), (*room.goal, 0.0), guide=str(path))


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_predictions_that_are_not_finite_are_refused(room, make_weights, value):
    guide = str(make_weights(value, name="nonsense"))
    with pytest.raises(InvalidWeights, match="nonsense"):
        pf.propose_region(room.grid, room.robot, room.start, room.goal, guide=guide)


def test_predictions_that_are_no_probabilities_are_refused(room, make_weights):
    guide = str(make_weights(7.0))
    with pytest.raises(InvalidParameter, match="between 0 and 1"):
        pf.propose_region(room.grid, room.robot, room.start, room.goal, guide=guide)


def test_a_proposer_has_its_own_threshold(room, make_weights):
    proposer = OnnxProposer(load_network(str(make_weights(0.4))), threshold=0.5)
    ends = room.start, room.goal
    assert not pf.propose_region(room.grid, room.robot, *ends, guide=proposer).mask.any()
    with pytest.raises(InvalidParameter, match="OnnxProposer"):
        pf.plan(room.grid, room.robot, *ends, guide=proposer, threshold=0.3)


def test_without_a_selected_anchor_the_whole_map_is_searched(room, make_weights):
    guide = str(make_weights(0.4))
    ends = room.start, room.goal
    search = {"planner": "RRTstar", "target_length": 100.0, "time_limit": 60.0, "seed": 1}
    guided = pf.plan(room.grid, room.robot, *ends, guide=guide, threshold=0.5, **search)
    unguided = pf.plan(room.grid, room.robot, *ends, guide=None, **search)
    assert not guided.region.connected
    np.testing.assert_array_equal(guided.path, unguided.path)


def test_a_region_with_headings_guides_a_car(room):
    class Northwards:
        def propose(self, problem):
            shape = (4, 6)
            scale = load_network("mpt").scale
            headings = np.full(shape, np.pi / 2)
            return make_region(problem, np.ones(shape, np.float32), scale, headings=headings)

    car = pf.ReedsSheppCar(radius=0.1, turning_radius=0.3)
    states = (*room.start, 0.0), (*room.goal, 0.0)
    result = pf.plan(
        room.grid, car, *states, guide=Northwards(), target_length=100.0, time_limit=60.0, seed=1
    )
    assert result.solved
    assert result.region.connected


@pytest.mark.parametrize("guide", [object(), 3, OnnxProposer.propose, {"mpt"}])
def test_what_cannot_propose_is_no_guide(room, guide):
    with pytest.raises(UnknownGuide, match="RegionProposer"):
        pf.propose_region(room.grid, room.robot, room.start, room.goal, guide=guide)


def test_guided_plans_run_in_parallel_threads(room):
    def run(seed):
        ends = room.start, room.goal
        return pf.plan(room.grid, room.robot, *ends, max_vertices=300, time_limit=60.0, seed=seed)

    alone = [run(seed) for seed in range(4)]
    with ThreadPoolExecutor(4) as threads:
        together = list(threads.map(run, range(4)))
    for one, other in zip(alone, together, strict=True):
        np.testing.assert_array_equal(one.path, other.path)
