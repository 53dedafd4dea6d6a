"""Regions and paths without ROS: what is answered to what."""

from __future__ import annotations

import math
import threading
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import planformer as pf
import pytest
from planformer import CancelToken
from planformer.errors import InvalidMap
from planformer.maps import Costmap
from planformer.maps.costmap import inflated, with_patch, with_unknown_free

from planformer_ros.error_codes import ErrorCode
from planformer_ros.path import answer_path
from planformer_ros.problem import prepare
from planformer_ros.region import answer_region
from planformer_ros.settings import Settings
from planformer_ros.world import Snapshot, World

# Enough for any machine: RRTConnect stops at the first path.
SETTINGS = Settings(planner="RRTConnect", time_limit=100.0, seed=1)
START, GOAL = (1.0, 1.0, 0.0), (23.0, 23.0, 1.0)


@pytest.fixture(scope="module")
def forest() -> Costmap:
    return inflated(Costmap.from_grid(pf.generate_forest(seed=1)), 0.2)


def plan(costmap, settings=SETTINGS, start=START, goal=GOAL, planner_id="", cancel=None):
    snapshot = Snapshot(costmap, is_inflated=True)
    token = CancelToken() if cancel is None else cancel
    return answer_path(lambda: snapshot, start, goal, planner_id, settings, token)


class TestRegions:
    def test_a_region_is_that_of_the_library(self, forest):
        answer = answer_region(forest, START, GOAL, "", SETTINGS)
        assert (answer.code, answer.message) == (ErrorCode.NONE, "")
        region = pf.propose_region(forest.grid, pf.PointRobot(0.0), START[:2], GOAL[:2])
        np.testing.assert_array_equal(answer.mask, region.mask)

    def test_weights_of_the_request_count_before_those_of_the_settings(self, forest):
        by_default = answer_region(forest, START, GOAL, "", replace(SETTINGS, guide="unet"))
        by_request = answer_region(forest, START, GOAL, "unet", SETTINGS)
        np.testing.assert_array_equal(by_default.mask, by_request.mask)

    def test_an_unguided_planner_still_proposes_regions(self, forest):
        assert answer_region(forest, START, GOAL, "", replace(SETTINGS, guide="none")).code == 0

    @pytest.mark.parametrize("guide", ["oracle", "/absent.onnx", "mpt-dubins"])
    def test_weights_that_are_missing_or_do_not_suit(self, forest, guide):
        answer = answer_region(forest, START, GOAL, guide, SETTINGS)
        assert answer.code is ErrorCode.INVALID_PLANNER
        assert answer.mask is None

    def test_damaged_weights(self, forest, tmp_path):
        file = tmp_path / "damaged.onnx"
        file.write_bytes(b"no network")
        answer = answer_region(forest, START, GOAL, str(file), SETTINGS)
        assert answer.code is ErrorCode.INVALID_PLANNER
        assert Path(file).name in answer.message

    def test_a_map_that_does_not_connect(self):
        costs = np.zeros((40, 40), np.uint8)
        costs[:, 20] = 254
        answer = answer_region(Costmap(costs), (0.5, 0.5, 0.0), (1.5, 0.5, 0.0), "", SETTINGS)
        assert answer.code is ErrorCode.NO_VALID_PATH

    def test_what_the_inflation_lacks(self):
        costs = np.zeros((40, 80), np.uint8)
        costs[:, 40] = 254
        costs[18:22, 40] = 0  # a gap of 0.2 m
        ends = (0.5, 1.0, 0.0), (3.5, 1.0, 0.0)
        assert answer_region(Costmap(costs), *ends, "", SETTINGS).code == 0
        wide = replace(SETTINGS, costmap_radius=0.2)
        assert answer_region(Costmap(costs), *ends, "", wide).code is ErrorCode.NO_VALID_PATH

    @pytest.mark.parametrize("allowed", [True, False])
    def test_unknown_space(self, allowed):
        costs = np.zeros((40, 80), np.uint8)
        costs[:, 30:50] = 255
        settings = replace(SETTINGS, allow_unknown=allowed)
        answer = answer_region(Costmap(costs), (0.5, 1.0, 0.0), (3.5, 1.0, 0.0), "", settings)
        assert answer.code == (ErrorCode.NONE if allowed else ErrorCode.NO_VALID_PATH)

    def test_few_cells_of_great_size(self):
        huge = Costmap(np.zeros((480, 480), np.uint8), 1000.0)
        answer = answer_region(huge, START, GOAL, "", SETTINGS)
        assert answer.code is ErrorCode.UNKNOWN
        assert "max_pixels" in answer.message

    def test_a_yaw_that_is_no_number(self, forest):
        answer = answer_region(forest, START, (*GOAL[:2], math.nan), "", SETTINGS)
        assert answer.code is ErrorCode.UNKNOWN
        assert "unit quaternion" in answer.message


class TestPaths:
    @pytest.mark.parametrize("robot", ["point", "dubins", "reeds_shepp"])
    def test_a_path_is_valid(self, forest, robot):
        settings = replace(SETTINGS, robot=robot)
        answer = plan(forest, settings)
        assert (answer.code, answer.message, answer.cancelled) == (ErrorCode.NONE, "", False)
        made = settings.make_robot()
        assert pf.path_is_valid(forest.grid, made, answer.poses[:, : made.state_dimension])
        np.testing.assert_allclose(answer.poses[0, :2], START[:2])
        np.testing.assert_allclose(answer.poses[-1], GOAL)
        assert answer.region is not None
        assert answer.region.shape == forest.costs.shape
        assert not answer.fallback

    def test_without_a_guide(self, forest):
        answer = plan(forest, replace(SETTINGS, guide="none"))
        assert (answer.code, answer.region, answer.fallback) == (ErrorCode.NONE, None, "")

    def test_a_region_that_cannot_be_proposed_falls_back(self, forest):
        settings = replace(SETTINGS, guide="oracle")
        answer = plan(forest, settings)
        assert answer.code is ErrorCode.NONE
        assert answer.region is None
        assert "oracle" in answer.fallback
        answer = plan(forest, replace(settings, fallback=False))
        assert answer.code is ErrorCode.INVALID_PLANNER

    def test_a_region_that_does_not_connect_falls_back(self, forest):
        settings = replace(SETTINGS, threshold=1.0)  # no cell is that certain
        answer = plan(forest, settings)
        assert answer.code is ErrorCode.NONE
        assert "does not connect" in answer.fallback
        assert plan(forest, replace(settings, fallback=False)).code is ErrorCode.NO_VALID_PATH

    def test_a_search_in_the_region_that_fails_falls_back(self, forest):
        # So few samples suffice on the whole map, but not in the region: close ones do not connect.
        settings = replace(SETTINGS, planner="BFMT", max_vertices=20)
        answer = plan(forest, settings)
        assert (answer.code, answer.region) == (ErrorCode.NONE, None)
        assert "found no path" in answer.fallback
        assert plan(forest, replace(settings, fallback=False)).code is ErrorCode.NO_VALID_PATH

    def test_a_learned_planner_takes_no_region(self, forest):
        answer = plan(forest, planner_id="MPNet", goal=(3.0, 3.0, 0.0))
        assert (answer.code, answer.region) == (ErrorCode.NONE, None)

    def test_obstacles_between_start_and_goal_are_known_without_a_region(self):
        occupied = np.zeros((100, 100), bool)
        occupied[50] = True
        costmap = Costmap.from_grid(pf.OccupancyGrid(occupied, 0.25))
        for_cars = replace(SETTINGS, guide="mpt-dubins", fallback=False)  # cannot propose here
        assert plan(costmap, for_cars).code is ErrorCode.NO_VALID_PATH

    def test_no_map(self):
        answer = answer_path(lambda: None, START, GOAL, "", SETTINGS, CancelToken())
        assert answer.code is ErrorCode.TIMEOUT
        assert "no map yet" in answer.message

    def test_cancelled_before_it_began(self, forest):
        token = CancelToken()
        token.cancel()
        answer = plan(forest, cancel=token)
        assert answer.cancelled
        assert len(answer.poses) == 0

    def test_cancelled_from_another_thread(self, forest):
        token = CancelToken()
        settings = replace(SETTINGS, planner="RRTstar")  # improves its path until time is up
        timer = threading.Timer(0.2, token.cancel)
        timer.start()
        answer = plan(forest, settings, cancel=token)
        timer.join()
        assert answer.cancelled
        assert answer.seconds < settings.time_limit

    def test_a_map_that_changes_blocks_no_path(self, forest):
        """The first path is found on a map that is out of date by then."""
        first = plan(forest)
        rows, columns = forest.grid.to_rc(first.poses[len(first.poses) // 2, :2])
        wall = np.full((21, 21), 254, np.uint8)
        later = with_patch(forest, wall, int(columns) - 10, int(rows) - 10)
        snapshots = [Snapshot(forest, True), *[Snapshot(later, True)] * 9]
        answer = answer_path(
            lambda: snapshots.pop(0) if len(snapshots) > 1 else snapshots[0],
            START,
            GOAL,
            "",
            SETTINGS,
            CancelToken(),
        )
        assert answer.code is ErrorCode.NONE
        assert pf.path_is_valid(later.grid, pf.PointRobot(0.0), answer.poses[:, :2])

    def test_a_goal_that_is_built_over_meanwhile(self, forest):
        wall = np.full((5, 5), 254, np.uint8)
        row, column = forest.grid.to_rc(GOAL[:2])
        later = Snapshot(with_patch(forest, wall, int(column) - 2, int(row) - 2), True)
        snapshots = [Snapshot(forest, True)]
        answer = answer_path(
            lambda: snapshots.pop() if snapshots else later,
            START,
            GOAL,
            "",
            SETTINGS,
            CancelToken(),
        )
        assert answer.code is ErrorCode.GOAL_OCCUPIED

    def test_nothing_is_planned_on_an_old_costmap(self, forest):
        old = Snapshot(forest, is_inflated=True, received=time.monotonic() - 60.0)
        plain = replace(old, is_inflated=False)

        def answer(snapshot, limit):
            settings = replace(SETTINGS, costmap_timeout=limit, robot_radius=0.0)
            return answer_path(lambda: snapshot, START, GOAL, "", settings, CancelToken())

        refused = answer(old, 5.0)
        assert refused.code is ErrorCode.TIMEOUT
        assert "the costmap is 60." in refused.message
        assert "costmap_timeout" in refused.message
        assert not refused.poses.size
        assert answer(old, 0.0).code is ErrorCode.NONE
        assert answer(old, 90.0).code is ErrorCode.NONE
        assert answer(plain, 5.0).code is ErrorCode.NONE


class TestWorld:
    def test_a_costmap_counts_before_a_map(self):
        world = World()
        assert world.newest() is None
        world.set_map(Costmap([[0]]))
        assert not world.newest().is_inflated
        world.set_costmap(Costmap([[1]]))
        world.set_map(Costmap([[2]]))
        assert world.newest().is_inflated
        assert world.newest().costmap == Costmap([[1]])

    def test_the_same_map_is_the_same_object(self):
        world = World()
        world.set_map(Costmap([[0]]))
        assert world.newest() is world.newest()

    def test_an_update_is_another_map(self):
        world = World()
        with pytest.raises(InvalidMap, match="before the costmap"):
            world.update_costmap(np.zeros((1, 1), np.uint8), 0, 0)
        world.set_costmap(Costmap([[0, 0]]))
        before = world.newest()
        world.update_costmap(np.full((1, 1), 254, np.uint8), 1, 0)
        assert world.newest() is not before
        assert world.newest().costmap == Costmap([[0, 254]])
        assert before.costmap == Costmap([[0, 0]])

    def test_a_plain_map_is_inflated_by_the_robot_and_a_costmap_is_not(self):
        costs = np.zeros((40, 40), np.uint8)
        costs[:, 20] = 254
        ends = (0.5, 1.0, 0.0), (0.7, 1.0, 0.0)
        settings = Settings(robot_radius=0.2)
        plain = prepare(Snapshot(Costmap(costs), is_inflated=False), *ends, settings)
        costmap = prepare(Snapshot(Costmap(costs), is_inflated=True), *ends, settings)
        assert plain.problem.blocked.sum() > costmap.problem.blocked.sum() == 40

    def test_a_map_is_inflated_once_for_each_robot(self):
        costs = np.zeros((40, 40), np.uint8)
        costs[:, 20], costs[0, 0] = 254, 255
        snapshot = Snapshot(Costmap(costs), is_inflated=False)
        first = snapshot.for_robot(0.1, unknown_is_free=False)
        assert snapshot.for_robot(0.1, unknown_is_free=False) is first
        assert first == inflated(Costmap(costs), 0.1)
        assert snapshot.for_robot(0.2, unknown_is_free=False) == inflated(Costmap(costs), 0.2)
        opened = snapshot.for_robot(0.0, unknown_is_free=True)
        assert opened == with_unknown_free(Costmap(costs))
