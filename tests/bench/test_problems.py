from __future__ import annotations

import dataclasses
import math
import zlib

import numpy as np
import pytest

import planformer as pf
from planformer.bench.problems import PROBLEMS_PER_MAP, make_problem
from planformer.bench.rows import MapFile, Row, Scene, all_rows
from planformer.errors import InvalidParameter
from planformer.geometry import polyline_length
from planformer.maps import load_scenarios


def test_a_problem_depends_on_row_number_and_seed_alone(small_row):
    known = make_problem(small_row, 5, seed=3)
    for index in range(3):
        make_problem(small_row, index, seed=3)
    again = make_problem(small_row, 5, seed=3)
    assert again.problem.grid == known.problem.grid
    assert (again.problem.start, again.problem.goal) == (known.problem.start, known.problem.goal)
    assert again.seed == known.seed
    other = dataclasses.replace(small_row, name="other")
    for different in (make_problem(small_row, 5, seed=4), make_problem(other, 5, seed=3)):
        assert different.problem.grid != known.problem.grid


def test_a_few_problems_share_a_map(small_row):
    grids = [make_problem(small_row, i, 0).problem.grid for i in range(2 * PROBLEMS_PER_MAP)]
    starts = {make_problem(small_row, i, 0).problem.start for i in range(2 * PROBLEMS_PER_MAP)}
    assert len({grid.occupied.tobytes() for grid in grids}) == 2
    assert grids[0] == grids[PROBLEMS_PER_MAP - 1] != grids[PROBLEMS_PER_MAP]
    assert len(starts) == 2 * PROBLEMS_PER_MAP


def test_the_maps_are_not_those_of_training_data():
    row = all_rows()["forest-480"]
    seen = {
        make_problem(row, PROBLEMS_PER_MAP * i, 0).problem.grid.occupied.tobytes() for i in (0, 1)
    }
    for seed in range(3):  # as planformer.data.generate draws its maps
        for index in range(3):
            key = (zlib.crc32(b"forest"), index)
            sequence = np.random.SeedSequence(seed, spawn_key=key)
            map_seed = int(sequence.generate_state(2, np.uint64)[0])
            assert pf.generate_forest(map_seed).occupied.tobytes() not in seen
    evaluation, training = (
        np.random.SeedSequence(entropy, spawn_key=(1, 2)).generate_state(2, np.uint64).tolist()
        for entropy in (2**32, 0)
    )
    assert evaluation != training


def test_the_reference_is_a_valid_path(small_row, car_row):
    for row in (small_row, car_row):
        known = make_problem(row, 0, seed=0)
        problem = known.problem
        assert pf.path_is_valid(problem.grid, problem.robot, known.reference)
        assert tuple(known.reference[0]) == problem.start
        assert tuple(known.reference[-1]) == problem.goal
        assert known.reference_length == pytest.approx(polyline_length(known.reference))
        assert known.target_length == row.slack * known.reference_length


def test_start_and_goal_are_as_far_apart_as_the_row_says(small_row):
    row = dataclasses.replace(small_row, min_distance=3.5, max_distance=4.0)
    for index in range(6):
        problem = make_problem(row, index, seed=0).problem
        assert 3.5 <= np.hypot(*np.subtract(problem.goal, problem.start)) <= 4.0


def test_scenes_take_turns_map_by_map(small_row):
    scenes = [dataclasses.replace(small_row.scenes[0], name=name) for name in ("a", "b")]
    row = dataclasses.replace(small_row, scenes=tuple(scenes))
    names = [make_problem(row, PROBLEMS_PER_MAP * number, 0).scene for number in range(4)]
    assert names == ["a", "b", "a", "b"]


def test_a_row_without_room_says_so(tmp_path):
    path = tmp_path / "full.npy"
    np.save(path, np.ones((9, 9), bool))
    row = Row("full", (Scene("", MapFile(path, 0.05), pf.PointRobot()),))
    with pytest.raises(InvalidParameter, match="attempts gave no problem 0 of the row full"):
        make_problem(row, 0, seed=0)


def test_scenarios_are_problems_of_the_file(real_maps):
    row = all_rows(real_maps)["scenarios-32room_000"]
    (scene,) = row.scenes
    grid = scene.maps.grid(0)
    ends = {s.start_and_goal(grid) for s in load_scenarios(scene.scenarios)}
    drawn = [make_problem(row, index, seed=0).problem for index in range(5)]
    assert len({(p.start, p.goal) for p in drawn}) == 5
    for problem in drawn:
        assert (problem.start, problem.goal) in ends
        assert math.dist(problem.start, problem.goal) >= row.min_distance


def test_too_few_scenarios_are_refused(real_maps, tmp_path):
    row = all_rows(real_maps)["scenarios-32room_000"]
    file = tmp_path / "few.scen"
    file.write_text("\n".join(row.scenes[0].scenarios.read_text().splitlines()[:3]))
    few = dataclasses.replace(row, scenes=(dataclasses.replace(row.scenes[0], scenarios=file),))
    with pytest.raises(InvalidParameter, match="gave no problem"):
        make_problem(few, 0, seed=0)
