"""Many queries on one map."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from concurrent.futures import FIRST_EXCEPTION, ThreadPoolExecutor, wait
from typing import Any

from planformer.api import plan, propose_region
from planformer.errors import InvalidParameter, UnknownGuide
from planformer.guidance import AUTO, Guide, Region, resolve_guide
from planformer.maps import OccupancyGrid
from planformer.planning import CancelToken, PlanResult
from planformer.processes import cores
from planformer.robots import Robot

Query = tuple[Sequence[float], Sequence[float]]


class MapSession:
    """Plans on one map, again and again.

    What depends on the map alone, such as its inflation by the robot, is computed with the first
    query; the guide is loaded once. Queries may come from several threads.

    Args:
        grid: The map.
        robot: The robot.
        guide: As in `planformer.plan`.
        threshold: As in `planformer.plan`.

    Raises:
        UnknownGuide: No such weights.
        InvalidWeights: Their files are damaged.
        InvalidParameter: The threshold is out of range, or the guide is not given by name.
    """

    def __init__(
        self,
        grid: OccupancyGrid,
        robot: Robot,
        *,
        guide: Guide | None = AUTO,
        threshold: float | None = None,
    ) -> None:
        self._grid = grid
        self._robot = robot
        if guide is None and threshold is not None:
            raise InvalidParameter("a threshold needs the name of weights as guide")
        self._guide = None if guide is None else resolve_guide(guide, robot, threshold)

    @property
    def grid(self) -> OccupancyGrid:
        """The map that the next query sees."""
        return self._grid

    @property
    def robot(self) -> Robot:
        """The robot."""
        return self._robot

    def update(self, grid: OccupancyGrid) -> None:
        """Replace the map; queries that have begun end on the former one."""
        self._grid = grid

    def propose_region(self, start: Sequence[float], goal: Sequence[float]) -> Region:
        """Propose a region; see `planformer.propose_region`.

        Raises:
            UnknownGuide: The session has no guide.
        """
        if self._guide is None:
            raise UnknownGuide("this session has no guide to propose a region")
        return propose_region(self._grid, self._robot, start, goal, guide=self._guide)

    def plan(self, start: Sequence[float], goal: Sequence[float], **options: Any) -> PlanResult:
        """Plan a path; other options, and errors, are those of `planformer.plan`."""
        return plan(self._grid, self._robot, start, goal, **{"guide": self._guide, **options})

    def plan_all(
        self, queries: Iterable[Query], *, workers: int | None = None, **options: Any
    ) -> list[PlanResult]:
        """Plan many paths at once, on several cores.

        Args:
            queries: Start and goal of each.
            workers: Number of threads, >= 1; None for one a core.
            **options: As in `planformer.plan`, the same for all; `cancel` ends all, and is
                cancelled when one fails.

        Returns:
            The results, in the order of the queries.

        Raises:
            InvalidParameter: There are no workers.
            PlanformerError: Of the first query that fails; it ends the others.
        """
        if workers is not None and workers < 1:
            raise InvalidParameter(f"workers must be >= 1; got {workers}")
        grid = self._grid
        grid.components(self._robot.radius)  # once, before the threads ask for it
        options = {"guide": self._guide, **options}
        cancel = options["cancel"] = options.get("cancel") or CancelToken()
        with ThreadPoolExecutor(workers or cores()) as pool:
            try:
                plans = [pool.submit(plan, grid, self._robot, *ends, **options) for ends in queries]
                done, _ = wait(plans, return_when=FIRST_EXCEPTION)
                return [future.result() for future in plans if future in done]
            except BaseException:  # an error or Ctrl-C: nobody waits for the other plans
                cancel.cancel()
                pool.shutdown(wait=False, cancel_futures=True)
                raise
