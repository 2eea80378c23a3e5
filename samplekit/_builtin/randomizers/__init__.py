"""Randomizers: they change the points of any sampler at random."""
