from __future__ import annotations

import subprocess
import sys

WITHOUT_ROS = ("error_codes", "path", "poses", "problem", "region", "settings", "world")
ROS = ("rclpy", "geometry_msgs", "nav_msgs", "nav2_msgs", "planformer_msgs", "std_msgs")


def test_what_decides_knows_no_ros():
    program = f"""
import importlib, sys
sys.modules |= dict.fromkeys({ROS!r})  # an import of them fails
for name in {WITHOUT_ROS!r}:
    importlib.import_module("planformer_ros." + name)
"""
    subprocess.run([sys.executable, "-c", program], check=True)
