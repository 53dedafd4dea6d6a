from __future__ import annotations

import gc
import sys
from pathlib import Path

import pytest

from planformer.planning import SearchLimits, planner_names, search

from .conftest import DUBINS, POINT, REEDS_SHEPP, random_problem

MEGABYTE = 2**20


def resident_bytes():
    gc.collect()
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * 4096


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="reads /proc")
@pytest.mark.parametrize(
    ("robot", "planners"),
    [
        (POINT, ["RRTConnect", "RRTstar", "BITstar"]),
        (POINT, [name for name in planner_names(POINT) if name not in ("AITstar", "FMT")]),
        (DUBINS, ["RRTConnect", "RRTstar", "BITstar", "SST"]),
        (REEDS_SHEPP, ["RRTConnect", "InformedRRTstar", "ABITstar"]),
    ],
    ids=["often", "all", "Dubins", "ReedsShepp"],
)
@pytest.mark.parametrize("keep_tree", [False, True], ids=["", "tree"])
def test_memory_stays_flat_over_many_plans(open_room, robot, planners, keep_tree):
    problem = random_problem(open_room, robot, 2)
    limits = SearchLimits(60.0, target_length=1000.0)

    def plan_often(count):
        for seed in range(count):
            planner = planners[seed % len(planners)]
            search(problem, planner, limits=limits, seed=seed, keep_tree=keep_tree)

    plans = 2000 if robot is POINT and len(planners) == 3 else 300
    plan_often(plans // 4)
    before = resident_bytes()
    plan_often(plans)
    assert resident_bytes() - before < 20 * MEGABYTE


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="reads /proc")
@pytest.mark.parametrize("planner", ["LazyPRMstar", "SORRTstar"])
def test_what_destructors_of_ompl_forget_is_freed(forest, planner):
    """LazyPRM*'s states, and the samples that SORRT* has not used: 5 and 6 kB a plan."""
    problem = random_problem(forest, POINT, 2, apart=(4.0, 12.0))
    limits = SearchLimits(60.0, max_vertices=60)

    def plan_often(count):
        for seed in range(count):
            search(problem, planner, limits=limits, seed=seed)

    plan_often(100)
    before = resident_bytes()
    plan_often(800)
    assert resident_bytes() - before < 2 * MEGABYTE
