"""Scenes: one file each, with the dimensions that it needs, its value, and its exact mean over a pixel."""
