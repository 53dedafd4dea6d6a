from __future__ import annotations

import math

import pytest

from planformer.data.settings import PRESETS, settled
from planformer.errors import InvalidParameter


def test_the_papers_sets():
    paper, _ = settled({}, preset="paper")
    assert (paper.kinds, paper.maps, paper.paths_per_map) == (("forest", "maze"), 1750, 25)
    assert (paper.width, paper.height, paper.resolution) == (24.0, 24.0, 0.05)
    assert (paper.robot, paper.robot_radius, paper.max_distance) == ("point", 0.1, None)
    car, _ = settled({}, preset="paper-dubins")
    assert (car.kinds, car.maps, car.paths_per_map) == (("forest",), 900, 25)
    assert (car.robot_radius, car.min_distance, car.max_distance) == (0.2, 4.0, 15.0)
    assert car.turning_radius == pytest.approx(0.3 / math.tan(0.5))


@pytest.mark.parametrize("preset", PRESETS)
def test_a_preset_leaves_amount_seed_and_expert_to_choose(preset):
    asked = {"maps": 7, "paths_per_map": 2, "seed": 9, "expert": "rrtstar", "expert_vertices": 50}
    spec, _ = settled(asked, preset=preset)
    assert {name: getattr(spec, name) for name in asked} == asked


@pytest.mark.parametrize(
    "asked", [{"robot_radius": 0.1}, {"kinds": ["maze"]}, {"width": 12.0}, {"max_distance": 9.0}]
)
def test_a_preset_and_what_it_fixes_do_not_go_together(asked):
    with pytest.raises(InvalidParameter, match=f"paper fixes {next(iter(asked))}"):
        settled(asked, preset="paper")


def test_a_preset_and_maps_of_ones_own_do_not_go_together(own_maps):
    with pytest.raises(InvalidParameter, match="paper fixes maps_from"):
        settled({}, preset="paper", maps_from=own_maps)


def test_unknown_names_are_errors_that_list_the_known_ones():
    with pytest.raises(InvalidParameter, match="choose from paper, paper-dubins"):
        settled({}, preset="Paper")
    with pytest.raises(InvalidParameter, match=r"unknown settings size; known: expert, .*width"):
        settled({"maps": 1, "size": 24.0})
    with pytest.raises(InvalidParameter, match="robot must be one of dubins, point"):
        settled({"maps": 1, "robot": "tank"})


def test_defaults_suit_the_robot():
    point, _ = settled({"maps": 1})
    car, _ = settled({"maps": 1, "robot": "dubins", "robot_radius": None, "max_distance": 9.0})
    assert (point.expert, point.robot_radius, point.min_distance) == ("lazy-theta", 0.1, 3.0)
    assert (car.robot_radius, car.min_distance, car.max_distance) == (0.2, 4.0, 9.0)
    assert car.expert != point.expert
