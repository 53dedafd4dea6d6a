"""A plan in words."""

from __future__ import annotations

from planformer.planning import PlanResult, PlanStatus


def caption(result: PlanResult) -> str:
    """One line on the outcome: status, length, vertices, region and times."""
    parts = [outcome(result)]
    if result.solved:
        parts.append(f"{result.length:.2f} m")
    parts.append(f"{result.vertices:,} vertices")
    if result.region is not None:
        parts.append(f"region {result.region.share:.1%} of the map")
        parts.append(f"proposal {duration(result.proposal_seconds)}")
    parts.append(f"planning {duration(result.planning_seconds)}")
    return "  ·  ".join(parts)


def outcome(result: PlanResult) -> str:
    """Whether there is a path, and why the search ended where that says more."""
    if not result.solved:
        return f"no path: {result.status.value}"
    plain = result.status is PlanStatus.FINISHED
    return "path found" if plain else f"path found ({result.status.value})"


def duration(seconds: float) -> str:
    """A readable time, in milliseconds below a second."""
    return f"{seconds:.2f} s" if seconds >= 1.0 else f"{seconds * 1e3:.3g} ms"
