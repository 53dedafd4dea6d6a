"""The package as colcon (ament_python) and pip install it."""

from pathlib import Path

from setuptools import setup

NAME = "planformer_ros"


def files(folder: str) -> tuple[str, list[str]]:
    """Where a folder's files are installed, and the files."""
    found = (path for path in Path(folder).iterdir() if path.is_file())  # no __pycache__
    return f"share/{NAME}/{folder}", sorted(map(str, found))


setup(
    name=NAME,
    version="0.1.0",
    description="Proposes regions and plans paths for Nav2 with planformer",
    maintainer="The planformer authors",
    maintainer_email="authors@planformer.invalid",
    license="BSD-3-Clause",
    packages=[NAME],
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{NAME}"]),
        (f"share/{NAME}", ["package.xml"]),
        files("config"),
        files("launch"),
        files("rviz"),
    ],
    python_requires=">=3.10",
    install_requires=["planformer"],
    entry_points={"console_scripts": ["planner = planformer_ros.main:main"]},
)
