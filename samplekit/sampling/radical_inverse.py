"""The radical inverse: the digits of an index mirrored at the point (van der Corput 1935; Halton 1960).

Digits stay integers until one correctly rounded division, so no value reaches 1 and none drifts.
"""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

import numpy as np

from samplekit.numerics.kernel import helper, kernel

if TYPE_CHECKING:
    from numpy.typing import NDArray


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


@kernel("void(float64[::1], int64, int64)")
def radical_inverses(out: NDArray[np.float64], base: int, start: int) -> None:
    """Write the radical inverses of start, start + 1, ... in ``base`` into ``out``; indices below 2^53 / base.

    Counts like an odometer: adding one to the index changes the mirrored integer by its leading digits alone.
    """
    power = largest_power(base, 1 << 53)
    mirrored = 0
    weight = power
    rest = start
    while rest > 0:
        weight //= base
        mirrored += (rest % base) * weight
        rest //= base
    for i in range(out.size):
        out[i] = np.float64(mirrored) / np.float64(power)
        weight = power // base
        carry = (base - 1) * weight
        while mirrored >= carry and weight > 0:
            mirrored -= carry
            weight //= base
            carry = (base - 1) * weight
        mirrored += weight
