"""What the service may be asked for: every limit in one place."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, fields
from pathlib import Path

from planformer.errors import InvalidParameter
from planformer.processes import cores

LOOPBACK = ("127.0.0.1", "localhost", "::1")
"""Names of this machine that no other machine can reach."""


@dataclass(frozen=True)
class ServeSettings:
    """Limits of the service; what is above them is refused.

    Attributes:
        folder: Where uploaded maps are kept and maps are looked for; None keeps them in memory.
        hosts: Names by which the service may be addressed, so that no other site's page can reach
            it through a name of its own (DNS rebinding); None for any.
        plans: Searches at once.
        plan_seconds: Longest search that may be asked for.
        plan_vertices: Most vertices of a search.
        patience_seconds: How long a request waits for another's search to end before it is refused.
        runs_to_compare: Most searches in one comparison.
        upload_bytes: Largest upload.
        body_bytes: Largest other request.
        map_cells: Most cells of a map.
        maps: Most maps in memory, and in the folder.
        cells_in_memory: Most cells of all maps in memory; the least recently used give way.
        stroke_points: Most points of the strokes in one edit.
        progress_seconds: Time between two progress events of a stream.
        connections: Most connections at once.

    Raises:
        InvalidParameter: A limit is not positive, or one contradicts another.
    """

    folder: Path | None = None
    hosts: tuple[str, ...] | None = LOOPBACK
    plans: int = field(default_factory=cores)
    plan_seconds: float = 10.0
    plan_vertices: int = 200_000
    patience_seconds: float = 0.25
    runs_to_compare: int = 4
    upload_bytes: int = 16 * 2**20
    body_bytes: int = 2**20
    map_cells: int = 4_000_000
    maps: int = 256
    cells_in_memory: int = 32_000_000
    stroke_points: int = 10_000
    progress_seconds: float = 0.06
    connections: int = 200

    def __post_init__(self) -> None:
        for limit in fields(self):
            value = getattr(self, limit.name)
            if isinstance(value, (int, float)) and not (math.isfinite(value) and value > 0):
                raise InvalidParameter(f"{limit.name} must be finite and > 0; got {value}")
        if self.cells_in_memory < self.map_cells:
            raise InvalidParameter(
                f"cells_in_memory must be at least map_cells; got {self.cells_in_memory} and "
                f"{self.map_cells}"
            )
