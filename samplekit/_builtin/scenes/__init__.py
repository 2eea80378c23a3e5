"""Scenes: a file a scene, with what it needs, its value, and its exact mean over a pixel."""
