"""Samples near the best path so far."""

from __future__ import annotations

import numpy as np
import pytest

from planformer.geometry import distance_to_polyline, wrap_angle
from planformer.planning import (
    REFINEMENT,
    REFINEMENT_IN_REGION,
    SamplingRegion,
    SearchLimits,
    search,
)

from .conftest import DUBINS, POINT, REEDS_SHEPP, random_problem

REFINING = ["RRTstar", "InformedRRTstar", "SORRTstar", "BITstar", "ABITstar"]


@pytest.mark.parametrize("planner", REFINING)
def test_vertices_crowd_all_along_the_best_path(forest, planner):
    near = {}
    for refinement in (0.0, 0.5):
        result = search(
            random_problem(forest, POINT, 5),
            planner,
            refinement=refinement,
            limits=SearchLimits(60.0, max_vertices=1500),
            seed=1,
            keep_tree=True,
        )
        vertices = result.tree.vertices
        close = vertices[distance_to_polyline(vertices, result.path) < 0.1]
        # In each quarter of the way, so that both ends of the path are where they should be.
        along = (close[:, :2] - result.path[0]) @ (result.path[-1] - result.path[0])
        along = along / np.sum((result.path[-1] - result.path[0]) ** 2)
        near[refinement] = np.histogram(along, bins=4, range=(0.0, 1.0))[0]
    assert (near[0.5] > 2 * near[0.0] + 5).all(), near


@pytest.mark.parametrize("robot", [POINT, DUBINS, REEDS_SHEPP], ids=lambda r: type(r).__name__)
def test_paths_are_shorter_after_as_many_vertices(forest, robot):
    ratios = []
    for number in range(8):
        plain, refined = (
            search(
                random_problem(forest, robot, number),
                "RRTstar",
                refinement=refinement,
                limits=SearchLimits(60.0, max_vertices=600),
                seed=2,
            )
            for refinement in (0.0, 0.5)
        )
        if plain.solved and refined.solved:
            ratios.append(refined.length / plain.length)
    assert len(ratios) >= 5
    assert np.median(ratios) < 0.995, ratios


def test_a_car_is_sampled_with_the_headings_of_the_path(open_room):
    aligned = {}
    for refinement in (0.0, 1.0):
        result = search(
            random_problem(open_room, DUBINS, 3),
            "RRTstar",
            refinement=refinement,
            limits=SearchLimits(60.0, max_vertices=800),
            seed=1,
            keep_tree=True,
        )
        vertices = result.tree.vertices
        away = np.linalg.norm(vertices[:, None, :2] - result.path[:, :2], axis=-1)
        turn = wrap_angle(vertices[:, 2] - result.path[away.argmin(axis=1), 2])
        aligned[refinement] = np.mean(np.abs(turn[away.min(axis=1) < 0.1]) < 0.3)
    assert aligned[1.0] > max(0.8, 2 * aligned[0.0]), aligned


def test_the_first_path_is_the_same(forest):
    problem = random_problem(forest, POINT, 5)
    limits = SearchLimits(60.0, target_length=1000.0)
    plain, refined = (
        search(problem, "RRTstar", refinement=refinement, limits=limits, seed=3)
        for refinement in (0.0, 1.0)
    )
    assert (plain.path == refined.path).all()
    assert plain.vertices == refined.vertices


@pytest.mark.parametrize("guided", [False, True])
def test_by_default_a_region_is_refined_more_than_the_whole_map(forest, guided):
    middle = np.array([[forest.width, forest.height]]) / 2
    everywhere = SamplingRegion(middle, None, forest.width / 2, forest.width * forest.height)
    lengths = {
        refinement: search(
            random_problem(forest, POINT, 5),
            "RRTstar",
            region=everywhere if guided else None,
            refinement=refinement,
            limits=SearchLimits(60.0, max_vertices=500),
            seed=3,
        ).length
        for refinement in (None, REFINEMENT, REFINEMENT_IN_REGION)
    }
    assert (lengths[None] == lengths[REFINEMENT]) is not guided
    assert (lengths[None] == lengths[REFINEMENT_IN_REGION]) is guided
