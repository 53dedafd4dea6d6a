"""Learned planners that others published, to compare with: they plan without a region."""

from planformer.baselines.mpnet import MPNetPlanner
from planformer.baselines.mpnet_network import MPNetNetwork, load_mpnet

__all__ = ["MPNetNetwork", "MPNetPlanner", "load_mpnet"]
