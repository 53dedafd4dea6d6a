"""Ctrl-C while the core is searching."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

from planformer.planning import CancelToken, PlanResult


def stoppable(work: Callable[[CancelToken], PlanResult]) -> PlanResult:
    """Run a plan; Ctrl-C ends the search, which returns what it has found so far.

    The search runs in a thread because Python handles Ctrl-C in its main thread only, which must
    therefore not be inside the core.
    """
    cancel = CancelToken()
    with ThreadPoolExecutor(1) as pool:
        plan = pool.submit(work, cancel)
        try:
            return plan.result()
        except KeyboardInterrupt:
            cancel.cancel()
            return plan.result()
