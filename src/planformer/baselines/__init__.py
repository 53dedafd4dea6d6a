"""Learned planners that others published, to compare with: they plan without a region."""
