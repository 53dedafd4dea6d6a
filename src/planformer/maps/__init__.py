"""Maps: the occupancy grid, its file formats and generators."""

from planformer.maps.costmap import Costmap
from planformer.maps.forest import generate_forest
from planformer.maps.grid import OccupancyGrid
from planformer.maps.indoor import generate_indoor
from planformer.maps.io import load_map, save_map
from planformer.maps.maze import generate_maze
from planformer.maps.movingai import Scenario, load_scenarios

__all__ = [
    "Costmap",
    "OccupancyGrid",
    "Scenario",
    "generate_forest",
    "generate_indoor",
    "generate_maze",
    "load_map",
    "load_scenarios",
    "save_map",
]
