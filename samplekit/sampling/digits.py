"""Coordinates as integer numerators over a power of their base, for randomizers that work on digits."""

from __future__ import annotations

import numpy as np

from samplekit.numerics.kernel import helper
from samplekit.sampling.hashing import ONE_MINUS_EPSILON, second_key, unit

DIGITS_LIMIT = 1 << 51
"""Numerators are below this: float64 then carries them through a division and back without loss."""


@helper
def numerator(x: float, power: int) -> int:
    """The integer m for which ``x`` is nearest to m / power, at most power - 1.

    Exact for x = m / power rounded to float64, which can lie on either side of the fraction.
    """
    return min(int(x * np.float64(power) + 0.5), power - 1)


@helper
def fraction(m: int, key: np.uint64, power: int) -> float:
    """(m + r) / power with r in [0, 1) random by key alone: the digits past the last, shifted alike for all points."""
    return min((np.float64(m) + unit(second_key(key ^ np.uint64(power)))) / np.float64(power), ONE_MINUS_EPSILON)
