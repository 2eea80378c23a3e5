"""Samplers, scenes and randomizers as a user chose them: one object each, checked in one place."""
