"""The exponents that theory has for the variance in two dimensions, worst case and best case.

Pilleboue, Singh, Coeurjolly, Kazhdan, Ostromoukhov 2015, "Variance analysis for Monte Carlo integration", ACM TOG
34(4): the table that the course shows. The worst case is the indicator of a disk, the best a Gaussian.
"""

from __future__ import annotations

CASES = {"disk": "worst", "gaussian": "best"}
"""Scenes of the cases."""

EXPONENTS: dict[str, dict[str, float]] = {
    "random": {"worst": -1.0, "best": -1.0},
    "jittered": {"worst": -1.5, "best": -2.0},
    "poisson-disk": {"worst": -1.0, "best": -1.0},
    "ccvt": {"worst": -1.5, "best": -3.0},
}


def theory_of(scene: str, sampler: str) -> tuple[str | None, float | None]:
    """The case that a scene is, and the exponent of a sampler in it; both as on the command line."""
    case = CASES.get(scene.partition(":")[0].rpartition("/")[2])
    name = sampler.partition("+")[0].partition(":")[0].rpartition("/")[2]
    return case, EXPONENTS.get(name, {}).get(case) if case else None
