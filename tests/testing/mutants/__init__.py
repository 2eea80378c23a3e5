"""Deliberately broken samplers, each with the check that must catch it: the suite is tested with these.

A mutant wraps one of our own samplers and breaks one thing. Many are faults that real renderers and libraries have had.
``python tests/testing/mutation.py`` prints which check catches which.
"""

from mutants import density, distribution, effects, relations, requests, sizes, structure, values
from mutants.mutant import MUTANTS, Mutant

__all__ = [
    "MUTANTS",
    "Mutant",
    "density",
    "distribution",
    "effects",
    "relations",
    "requests",
    "sizes",
    "structure",
    "values",
]
