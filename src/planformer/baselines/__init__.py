"""Learned planners that others published, to compare with: they plan without a region."""

from planformer.baselines.learned import (
    LearnedPlanner,
    learned_planner_names,
    load_planner,
    planner_weights,
)
from planformer.baselines.mpnet import MPNetPlanner
from planformer.baselines.mpnet_network import MPNetNetwork, load_mpnet
from planformer.baselines.next_ks import NextPlanner
from planformer.baselines.next_network import NextOnnxNetwork, load_next

__all__ = [
    "LearnedPlanner",
    "MPNetNetwork",
    "MPNetPlanner",
    "NextOnnxNetwork",
    "NextPlanner",
    "learned_planner_names",
    "load_mpnet",
    "load_next",
    "load_planner",
    "planner_weights",
]
