"""Coordinates as integer numerators over a power of their base, for randomizers that work on digits."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit.kernels._compile import helper
from samplekit.kernels._hashing import second_key
from samplekit.kernels._stratification import offset_bits

if TYPE_CHECKING:
    from numpy.typing import NDArray

DIGITS_LIMIT = 1 << 45
"""Numerators are below this: float64 holds them with five digits more, and every prime up to 8161 reaches 2^32."""


@helper
def numerator(x: float, power: int) -> int:
    """The integer m for which ``x`` is nearest to m / power, at most power - 1.

    Exact for x = m / power rounded to float64, which can lie on either side of the fraction.
    """
    return min(int(x * np.float64(power) + 0.5), power - 1)


@helper
def tail_digits(key: np.uint64, power: int) -> float:
    """A random offset in (0, 1) within the cells of width 1 / power, by key alone: the digits past the last.

    So few bits that m plus the offset is exact, and stays in its cell when it is divided.
    """
    bits = offset_bits(power)
    return (np.float64(second_key(key ^ np.uint64(power)) >> np.uint64(64 - bits)) + 0.5) * 2.0 ** (-bits)


@helper
def fraction(m: int, tail: float, power: int) -> float:
    """(m + tail) / power."""
    return (np.float64(m) + tail) / np.float64(power)


@helper
def largest(numbers: NDArray[np.int64]) -> int:
    """The largest of at least one number, compiled in a tenth of the time of ``numbers.max()``."""
    found: int = numbers[0]
    for k in range(1, numbers.size):
        found = max(found, numbers[k])
    return found
