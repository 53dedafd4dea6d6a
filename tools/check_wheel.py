"""Check an installed wheel: it plans with shipped weights and loads OMPL from its own folder.

Run it with the Python of an environment into which the wheel was installed, and nothing else.
"""

from __future__ import annotations

import sys
import sysconfig
from pathlib import Path

import planformer as pf


def main() -> None:
    """Plan in a generated forest; exit with a message if the wheel is not self-contained."""
    grid = pf.generate_forest(1)
    start, goal = grid.nearest_free((1.0, 1.0), 0.1), grid.nearest_free((23.0, 23.0), 0.1)
    result = pf.plan(grid, pf.PointRobot(radius=0.1), start, goal, time_limit=1.0, seed=1)
    if not result.solved:
        sys.exit(f"no path: {result.status}")
    packages = Path(sysconfig.get_path("platlib")).resolve()
    foreign = [path for path in loaded_libraries("libompl") if packages not in path.parents]
    if foreign:
        sys.exit(f"OMPL comes from outside of the wheel: {foreign}")
    if not (Path(pf.__file__).parent / "serve" / "page" / "index.html").is_file():
        sys.exit("the page of the planning service is missing")
    print(f"{Path(pf.__file__).parent}: a path of {result.length:.2f} m; OMPL is the wheel's own")


def loaded_libraries(prefix: str) -> set[Path]:
    """The shared libraries in this process whose file name starts with the prefix."""
    lines = Path("/proc/self/maps").read_text(encoding="utf-8").splitlines()
    paths = {Path(line.split(maxsplit=5)[5]) for line in lines if line.count("/")}
    return {path for path in paths if path.name.startswith(prefix)}


if __name__ == "__main__":
    main()
