"""Point the CMake files of ROS's wheels to this interpreter: they hold their build machine's paths.

usage: python ros2/tools/repair_cmake.py
"""

from __future__ import annotations

import re
import sys
import sysconfig
from pathlib import Path

import numpy as np

BUILT_WITH = r"/opt/python/[^/;\"]+/"


def main() -> None:
    """Repair all files of this environment; a second time changes nothing."""
    headers, numpy_headers = sysconfig.get_path("include"), np.get_include()
    for file in Path(sys.prefix).glob("share/*/cmake/*.cmake"):
        text = file.read_text(encoding="utf-8")
        repaired = re.sub(BUILT_WITH + r"lib/[^;\"]+/numpy/_?core/include", numpy_headers, text)
        repaired = re.sub(BUILT_WITH + r"include/python[\d.]+", headers, repaired)
        if repaired != text:
            file.write_text(repaired, encoding="utf-8")


if __name__ == "__main__":
    main()
