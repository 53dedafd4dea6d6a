from __future__ import annotations

import array
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays

from planformer.errors import (
    GoalOccupied,
    GoalOutsideMap,
    InvalidMap,
    InvalidParameter,
    StartOccupied,
    StartOutsideMap,
)
from planformer.maps import Costmap, OccupancyGrid, costmap
from planformer.maps.costmap import DEAREST, INSCRIBED, LETHAL, UNKNOWN

COSTS = arrays(
    np.uint8,
    array_shapes(min_dims=2, max_dims=2, max_side=12),
    elements=st.sampled_from([0, 1, 128, DEAREST, INSCRIBED, LETHAL, UNKNOWN]),
)
ORIGINS = st.tuples(st.floats(-100, 100), st.floats(-100, 100), st.floats(-4, 4))
PLACED = st.builds(Costmap, COSTS, st.sampled_from([0.02, 0.05, 0.3]), ORIGINS)


def cells_of(world: Costmap) -> st.SearchStrategy[tuple[int, int]]:
    rows, columns = world.costs.shape
    return st.tuples(st.integers(0, rows - 1), st.integers(0, columns - 1))


def centre(world: Costmap, cell) -> tuple[float, float]:
    x, y = world.grid.to_xy(cell)
    return float(x), float(y)


def wall_world(inscribed: int = 3) -> Costmap:
    """A lethal wall along the low columns, its inscribed zone beside it, then free space."""
    costs = np.zeros((40, 40), np.uint8)
    costs[:, :4] = LETHAL
    costs[:, 4 : 4 + inscribed] = INSCRIBED
    return Costmap(costs, 0.05)


class TestValues:
    @given(PLACED)
    def test_what_nav2_closes_is_closed(self, world):
        np.testing.assert_array_equal(world.grid.occupied, world.costs >= 253)
        np.testing.assert_array_equal(world.grid.unknown, world.costs == 255)
        assert world.grid.resolution == world.resolution
        assert world.grid.origin == world.origin

    def test_rows_from_the_origin(self):
        world = Costmap.from_nav2([0, 10, 253, 254, 255, 252], 3, 2, 0.1, (1.0, 2.0, 0.0))
        assert world.costs.tolist() == [[0, 10, 253], [254, 255, 252]]
        assert world.grid.occupied.tolist() == [[False, False, True], [True, True, False]]
        assert world.grid.to_xy((1, 0)).tolist() == pytest.approx([1.05, 2.15])

    def test_a_turned_origin(self):
        world = Costmap([[0, 0], [0, 254]], 1.0, (5.0, 5.0, math.pi / 2))
        assert world.grid.to_rc((3.5, 6.5)).tolist() == [1, 1]
        with pytest.raises(GoalOccupied):
            costmap.check_goal(world, (3.5, 6.5))

    @pytest.mark.parametrize("container", [bytes, bytearray, list, np.array])
    def test_containers_of_messages(self, container):
        values = container([0, 253, 254, 255])
        if isinstance(values, bytes | bytearray):
            values = np.frombuffer(values, np.uint8)
        assert Costmap.from_nav2(values, 2, 2, 0.05).costs.ravel().tolist() == [0, 253, 254, 255]

    def test_arrays_of_the_standard_library(self):
        world = Costmap.from_published(array.array("b", [-1, 0, 99, 100]), 4, 1, 0.05)
        assert world.costs.tolist() == [[UNKNOWN, 0, INSCRIBED, LETHAL]]

    def test_published_values_are_nav2s(self):
        costs = np.arange(256).reshape(1, -1)
        values = Costmap(costs).to_published()
        assert values.dtype == np.int8
        assert values[[0, 1, 2, 126, 127, 252, 253, 254, 255]].tolist() == [
            *(0, 1, 1, 49, 49, 98, 99, 100, -1)
        ]
        assert (np.diff(values[:255]) >= 0).all()

    @given(arrays(np.int8, st.integers(1, 50), elements=st.integers(-1, 100)))
    def test_published_values_come_back(self, values):
        world = Costmap.from_published(values, len(values), 1, 0.05)
        np.testing.assert_array_equal(world.to_published(), values)

    @given(PLACED)
    def test_publishing_loses_nothing_that_planning_asks(self, world):
        rows, columns = world.costs.shape
        again = Costmap.from_published(
            world.to_published(), columns, rows, world.resolution, world.origin
        )
        assert again.grid == world.grid
        assert (again.costs <= world.costs).all()

    def test_a_plain_map(self):
        grid = OccupancyGrid.from_ros([-1, 0, 100, 50], 2, 2, 0.05, (1.0, 1.0, 0.3))
        world = Costmap.from_grid(grid)
        assert world.costs.tolist() == [[UNKNOWN, 0], [LETHAL, UNKNOWN]]
        assert world.grid == grid

    def test_costs_cannot_be_changed(self):
        source = np.zeros((2, 2), np.uint8)
        world = Costmap(source)
        source[0, 0] = 254
        assert world.costs[0, 0] == 0
        with pytest.raises(ValueError, match="read-only"):
            world.costs[0, 0] = 1

    def test_equality(self):
        assert Costmap([[0]]) == Costmap([[0]])
        assert hash(Costmap([[0]])) == hash(Costmap([[1]]))
        assert Costmap([[0]]) != Costmap([[1]])
        assert Costmap([[0]]) != Costmap([[0]], 0.1)
        assert Costmap([[0]]) != "costmap"
        assert "2 x 1 cells" in repr(Costmap([[0, 254]]))


class TestBadInput:
    @pytest.mark.parametrize(
        ("width", "height", "count"),
        [(0, 0, 0), (0, 5, 0), (3, 3, 8), (3, 3, 10), (-2, -2, 4), (2**31, 2**31, 4)],
    )
    def test_wrong_size(self, width, height, count):
        for make in (Costmap.from_nav2, Costmap.from_published):
            with pytest.raises(InvalidMap, match="width"):
                make(np.zeros(count, np.uint8), width, height, 0.05)

    @pytest.mark.parametrize("resolution", [math.nan, math.inf, 0.0, -0.05, "wide", None])
    def test_resolution(self, resolution):
        with pytest.raises(InvalidMap, match="resolution"):
            Costmap([[0]], resolution)

    @pytest.mark.parametrize("origin", [(math.nan, 0.0), (0.0,), (0.0, 0.0, math.inf), None])
    def test_origin(self, origin):
        with pytest.raises(InvalidMap, match="origin"):
            Costmap([[0]], 0.05, origin)

    @pytest.mark.parametrize("costs", [[[256]], [[-1]], [[0.5]], [["a"]], [[math.nan]]])
    def test_values(self, costs):
        with pytest.raises(InvalidMap, match="from 0 to 255"):
            Costmap(costs)

    @pytest.mark.parametrize("costs", [[], [[]], 5, [0, 1], [[[0]]]])
    def test_shape(self, costs):
        with pytest.raises(InvalidMap, match="non-empty"):
            Costmap(costs)

    @pytest.mark.parametrize("value", [-2, 101, 127])
    def test_published_values(self, value):
        with pytest.raises(InvalidMap, match="-1 to 100"):
            costmap.costs_from_published([value])

    def test_huge(self):
        huge = np.broadcast_to(np.uint8(0), (2**20, 2**20))  # no memory behind it
        with pytest.raises(InvalidMap, match="at most"):
            Costmap(huge)


class TestUpdates:
    @given(st.data())
    def test_a_patch_changes_its_rectangle_alone(self, data):
        world = data.draw(PLACED)
        (r0, c0), (r1, c1) = (data.draw(cells_of(world)) for _ in range(2))
        rows = slice(min(r0, r1), max(r0, r1) + 1)
        columns = slice(min(c0, c1), max(c0, c1) + 1)
        shape = rows.stop - rows.start, columns.stop - columns.start
        patch = data.draw(arrays(np.uint8, shape))
        changed = costmap.with_patch(world, patch, columns.start, rows.start)
        expected = world.costs.copy()
        expected[rows, columns] = patch
        assert changed == world.with_costs(expected)

    @pytest.mark.parametrize(("column", "row"), [(-1, 0), (0, -1), (3, 0), (0, 3), (2**40, 0)])
    def test_a_patch_beside_the_map(self, column, row):
        world = Costmap(np.zeros((4, 4), np.uint8))
        with pytest.raises(InvalidMap, match="does not lie on"):
            costmap.with_patch(world, np.zeros((2, 2), np.uint8), column, row)

    def test_a_patch_of_the_wrong_kind(self):
        world = Costmap(np.zeros((4, 4), np.uint8))
        with pytest.raises(InvalidMap, match="does not lie on"):
            costmap.with_patch(world, np.zeros(2, np.uint8), 0, 0)
        with pytest.raises(InvalidMap, match="0 to 255"):
            costmap.with_patch(world, [[300]], 0, 0)


class TestInflation:
    @given(PLACED, st.floats(0.0, 0.5))
    def test_a_point_on_the_inflated_map_is_a_disc_on_the_map(self, world, radius):
        wider = costmap.inflated(world, radius)
        np.testing.assert_array_equal(wider.grid.blocked(0.0), world.grid.blocked(radius))
        np.testing.assert_array_equal(wider.costs[world.closed], world.costs[world.closed])
        changed = wider.costs != world.costs
        assert (wider.costs[changed] == INSCRIBED).all()

    def test_a_bad_radius(self):
        with pytest.raises(InvalidParameter, match="radius"):
            costmap.inflated(Costmap([[0]]), -0.1)

    @given(PLACED)
    def test_unknown_can_be_free(self, world):
        opened = costmap.with_unknown_free(world)
        np.testing.assert_array_equal(
            opened.closed, (world.costs == LETHAL) | (world.costs == INSCRIBED)
        )


class TestStart:
    def test_a_free_start_changes_nothing(self):
        world = wall_world()
        assert costmap.with_way_out(world, (1.0, 1.0), 0.5) is world

    def test_the_robot_can_leave_the_inscribed_zone(self):
        world = wall_world(inscribed=6)
        start = (0.23, 1.03)  # the first inscribed column; free space begins at 0.5 m
        opened = costmap.with_way_out(world, start, 0.5)
        assert costmap.fallback_reason(world, np.ones((40, 40)), start, (1.5, 1.0)) is not None
        assert costmap.fallback_reason(opened, np.ones((40, 40)), start, (1.5, 1.0)) is None
        assert (opened.costs[world.costs == LETHAL] == LETHAL).all()
        assert (opened.costs != world.costs).sum() < 200  # a disc of 7 cells' radius at most

    @given(st.data())
    def test_only_inscribed_cells_open_and_only_near_the_start(self, data):
        world = data.draw(PLACED)
        start = centre(world, data.draw(cells_of(world)))
        reach = data.draw(st.floats(0.0, 1.0))
        try:
            opened = costmap.with_way_out(world, start, reach)
        except StartOccupied:
            return
        changed = opened.costs != world.costs
        assert (world.costs[changed] == INSCRIBED).all()
        assert (opened.costs[changed] == DEAREST).all()
        assert not opened.closed[tuple(opened.grid.to_rc(start))]
        distances = [math.dist(centre(world, cell), start) for cell in np.argwhere(changed)]
        assert max(distances, default=0.0) <= reach + world.resolution

    def test_a_start_too_deep_in_the_zone_names_the_way(self):
        with pytest.raises(StartOccupied, match="inscribed space") as caught:
            costmap.with_way_out(wall_world(inscribed=30), (0.23, 1.03), 0.5)
        assert caught.value.nearest_free == pytest.approx((1.725, 1.025))

    @pytest.mark.parametrize(("cost", "word"), [(LETHAL, "lethal"), (UNKNOWN, "unknown")])
    def test_a_start_in_an_obstacle(self, cost, word):
        world = Costmap([[cost, 0]], 1.0)
        with pytest.raises(StartOccupied, match=f"{word} space") as caught:
            costmap.with_way_out(world, (0.5, 0.5), 5.0)
        assert caught.value.nearest_free == (1.5, 0.5)

    def test_a_map_without_free_space(self):
        with pytest.raises(StartOccupied, match="nothing on this map"):
            costmap.with_way_out(Costmap([[INSCRIBED]]), (0.01, 0.01), 5.0)

    @pytest.mark.parametrize("start", [(-0.1, 1.0), (1.0, 99.0), (math.nan, 1.0), (math.inf, 0.0)])
    def test_a_start_beside_the_map(self, start):
        with pytest.raises(StartOutsideMap, match="outside the map"):
            costmap.with_way_out(wall_world(), start, 0.5)


class TestGoal:
    def test_a_free_goal(self):
        costmap.check_goal(wall_world(), (1.0, 1.0, 0.3))

    @pytest.mark.parametrize(
        ("cost", "word"), [(INSCRIBED, "inscribed"), (LETHAL, "lethal"), (UNKNOWN, "unknown")]
    )
    def test_a_closed_goal(self, cost, word):
        with pytest.raises(GoalOccupied, match=f"{word} space") as caught:
            costmap.check_goal(Costmap([[cost, 0]], 1.0), (0.5, 0.5))
        assert caught.value.nearest_free == (1.5, 0.5)

    @pytest.mark.parametrize("goal", [(-0.1, 1.0), (1.0, 99.0), (math.nan, 1.0), (math.inf, 0.0)])
    def test_a_goal_beside_the_map(self, goal):
        with pytest.raises(GoalOutsideMap, match="outside the map"):
            costmap.check_goal(wall_world(), goal)


class TestRegion:
    @given(st.data())
    def test_what_becomes_of_each_cell(self, data):
        world = data.draw(PLACED)
        start, goal = (centre(world, data.draw(cells_of(world))) for _ in range(2))
        mask = data.draw(arrays(np.bool_, world.costs.shape))
        keep = data.draw(st.floats(0.0, 0.5))
        closed = costmap.restricted(world, mask, start, goal, keep)
        for cell in np.ndindex(world.costs.shape):
            before, after = int(world.costs[cell]), int(closed.costs[cell])
            near = min(math.dist(centre(world, cell), state) for state in (start, goal))
            if mask[cell] or near < keep - 1e-9 or before == LETHAL:
                assert after == before
            elif near > max(keep + 1e-9, world.resolution):
                assert after == INSCRIBED

    @given(st.data())
    def test_the_cells_of_start_and_goal_stay(self, data):
        world = data.draw(PLACED)
        cells = [data.draw(cells_of(world)) for _ in range(2)]
        states = [centre(world, cell) for cell in cells]
        closed = costmap.restricted(world, np.zeros(world.costs.shape), *states)
        for cell in cells:
            assert closed.costs[cell] == world.costs[cell]

    @given(PLACED)
    def test_the_whole_map_as_region_changes_nothing(self, world):
        whole = np.ones(world.costs.shape, np.uint8)
        assert costmap.restricted(world, whole, (0.0, 0.0), (1.0, 1.0)) == world

    def test_states_beside_the_map_keep_what_their_discs_touch(self):
        world = Costmap(np.zeros((4, 4), np.uint8), 1.0)
        closed = costmap.restricted(world, np.zeros((4, 4)), (-0.5, 0.5), (9.0, 9.0), keep=1.1)
        assert (closed.costs == 0).sum() == 1

    def test_a_region_of_another_map(self):
        world = Costmap(np.zeros((4, 4), np.uint8))
        with pytest.raises(InvalidMap, match="another map"):
            costmap.restricted(world, np.ones((3, 4)), (0.1, 0.1), (0.1, 0.1))
        reason = costmap.fallback_reason(world, np.ones((3, 4)), (0.1, 0.1), (0.1, 0.1))
        assert reason is not None
        assert "another map" in reason

    @pytest.mark.parametrize("keep", [-1.0, math.nan, math.inf])
    def test_a_bad_radius(self, keep):
        with pytest.raises(InvalidParameter, match="keep"):
            costmap.restricted(Costmap([[0]]), [[1]], (0.0, 0.0), (0.0, 0.0), keep)


class TestFallback:
    START, GOAL = (0.025, 0.025), (0.225, 0.025)

    def test_a_region_that_connects_serves(self):
        world = Costmap(np.zeros((2, 5), np.uint8))
        assert costmap.fallback_reason(world, np.ones((2, 5)), self.START, self.GOAL) is None

    @pytest.mark.parametrize("cost", [0, INSCRIBED, LETHAL, UNKNOWN])
    def test_a_gap_in_region_or_map_does_not(self, cost):
        costs, mask = np.zeros((2, 5), np.uint8), np.ones((2, 5), bool)
        costs[:, 2] = cost
        mask[:, 2] = cost != 0
        reason = costmap.fallback_reason(Costmap(costs), mask, self.START, self.GOAL)
        assert reason == "the region does not connect start and goal"

    def test_corners_do_not_connect(self):
        mask = np.eye(5, dtype=bool)
        world = Costmap(np.zeros((5, 5), np.uint8))
        assert costmap.fallback_reason(world, mask, (0.025, 0.025), (0.225, 0.225)) is not None

    def test_an_empty_region(self):
        world = Costmap(np.zeros((2, 5), np.uint8))
        assert costmap.fallback_reason(world, np.zeros((2, 5)), self.START, self.GOAL) is not None
