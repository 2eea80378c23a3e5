"""Prime bases of radical inverses, and how many digits of one fit into a number."""

from __future__ import annotations

from functools import cache

import numpy as np

from samplekit.kernels._compile import helper


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
