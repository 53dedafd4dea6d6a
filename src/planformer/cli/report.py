"""What `planformer plan` says about a plan: summary, JSON, files."""

from __future__ import annotations

import csv
import io
import os
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from rich.text import Text

import planformer
from planformer.cli.console import print_facts, to_json
from planformer.errors import InvalidParameter
from planformer.files import make_folder, write_files
from planformer.planning import PlanResult
from planformer.plotting import save_picture
from planformer.plotting.words import duration, outcome

CSV, JSON, PICTURE = "path.csv", "path.json", "picture.png"
VERSION = 1
"""Version of the JSON record; raised when older readers would misread it."""


def require_writable(folder: Path) -> None:
    """Check that a folder, which need not exist, can be written to.

    Raises:
        InvalidParameter: It cannot.
    """
    nearest = next(path for path in (folder, *folder.absolute().parents) if path.exists())
    if not (nearest.is_dir() and os.access(nearest, os.W_OK | os.X_OK)):
        raise InvalidParameter(
            f"{folder}: cannot be written to: {nearest} is "
            f"{'read-only' if nearest.is_dir() else 'not a folder'}"
        )


@dataclass(frozen=True)
class PlanReport:
    """A plan with all that was asked for.

    Attributes:
        map_file: The map's file.
        robot_kind: Its name on the command line.
        planner: OMPL class name.
        guide: Name or path of the weights, None without a guide.
        seed: Seed of the search.
        result: The plan.
        folder: Folder for the files, None for none.
        picture: Whether to draw a picture.
    """

    map_file: Path
    robot_kind: str
    planner: str
    guide: str | None
    seed: int
    result: PlanResult
    folder: Path | None
    picture: bool

    @property
    def title(self) -> str:
        """One line on what was planned."""
        guide = f"guided by {Path(self.guide).stem}" if self.guide else "unguided"
        return f"{self.map_file.stem}  ·  {self.planner} {guide}"

    @property
    def files(self) -> dict[str, Path]:
        """The files that `write` makes, by what they hold."""
        if self.folder is None:
            return {}
        names = {"path": CSV, "record": JSON} | ({"picture": PICTURE} if self.picture else {})
        return {key: self.folder / name for key, name in names.items()}

    def write(self) -> None:
        """Write the files; each appears whole or not at all.

        Raises:
            InvalidParameter: The folder cannot be made or written to.
        """
        files = self.files
        if self.folder is None:
            return
        make_folder(self.folder)
        record = to_json(self.record()).encode()
        write_files({files["path"]: self.csv().encode(), files["record"]: record})
        if self.picture:
            save_picture(self.result.plot(title=self.title), files["picture"])

    def csv(self) -> str:
        """The path, one state a line under a header; the header alone without a path."""
        text = io.StringIO()
        writer = csv.writer(text, lineterminator="\n")
        writer.writerow(("x", "y", "yaw")[: self.result.problem.robot.state_dimension])
        writer.writerows(self.result.path.tolist())
        return text.getvalue()

    def record(self) -> dict[str, Any]:
        """The whole result as JSON-compatible values; metres, rad and seconds."""
        result, region = self.result, self.result.region
        problem = result.problem
        return {
            "version": VERSION,
            "planformer": planformer.__version__,
            "solved": result.solved,
            "status": result.status.value,
            "length": result.length if result.solved else None,
            "vertices": result.vertices,
            "planning_seconds": result.planning_seconds,
            "proposal_seconds": result.proposal_seconds,
            "planner": self.planner,
            "guide": self.guide,
            "seed": self.seed,
            "start": problem.start,
            "goal": problem.goal,
            "robot": {"kind": self.robot_kind, **asdict(problem.robot)},
            "map": {
                "file": str(self.map_file),
                "shape": problem.grid.shape,
                "resolution": problem.grid.resolution,
                "origin": problem.grid.origin,
            },
            "region": None
            if region is None
            else {
                "share": region.share,
                "threshold": region.threshold,
                "connected": region.connected,
            },
            "path": result.path.tolist(),
            "files": {k: str(v) for k, v in self.files.items()},
        }

    def print(self) -> None:
        """Print a summary for people."""
        result = self.result
        found = ("bold green" if result.solved else "bold red", outcome(result))
        print_facts(
            Text.assemble((self.title, "bold"), "\n", (found[1], found[0])),
            {
                **({"length": f"{result.length:.3f} m"} if result.solved else {}),
                "vertices": f"{result.vertices:,}",
                **({} if result.region is None else self._region_facts()),
                "planning": duration(result.planning_seconds),
                "seed": str(self.seed),
                "files": "\n".join(map(str, self.files.values())),
            },
        )

    def _region_facts(self) -> dict[str, str]:
        region = self.result.region
        joined = "start and goal connected" if region.connected else "start and goal NOT connected"
        return {
            "region": f"{region.share:.1%} of the map, threshold {region.threshold:.3g}, {joined}",
            "proposal": duration(self.result.proposal_seconds),
        }
