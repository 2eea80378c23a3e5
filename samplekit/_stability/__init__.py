"""Stability: test if estimates are right where scenes are stiff and requests extreme, and explain where not."""
