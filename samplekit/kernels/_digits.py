"""Digits in a prime base: the primes, and coordinates as integer numerators over a power of their base."""

from functools import cache

import numpy as np
from numpy.typing import NDArray

from samplekit.kernels._compile import helper
from samplekit.kernels._hashing import second_key
from samplekit.kernels._stratification import offset_bits

DIGITS_LIMIT = 1 << 45
"""Numerators are below this: float64 holds them with five digits more, and every prime up to 8161 reaches 2^32."""


@cache
def primes(count: int) -> tuple[int, ...]:
    """The first ``count`` primes, by Eratosthenes' sieve up to n (log n + log log n) (Rosser 1941)."""
    limit = 15 if count < 6 else int(count * (np.log(count) + np.log(np.log(count)))) + 1
    sieve = np.ones(limit + 1, bool)
    sieve[:2] = False
    for n in range(2, int(limit**0.5) + 1):
        if sieve[n]:
            sieve[n * n :: n] = False
    return tuple(int(p) for p in np.flatnonzero(sieve)[:count])


@helper
def largest_power(base: int, limit: int) -> int:
    """The largest power of ``base`` that is at most ``limit``."""
    power = base
    while power <= limit // base:
        power *= base
    return power


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
def largest(numbers: NDArray[np.int64]) -> int:
    """The largest of at least one number, compiled in a tenth of the time of ``numbers.max()``."""
    found: int = numbers[0]
    for k in range(1, numbers.size):
        found = max(found, numbers[k])
    return found
