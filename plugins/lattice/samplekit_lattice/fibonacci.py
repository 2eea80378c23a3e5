"""The Fibonacci lattice in 2D: N = F(k) points (i, i F(k-1)) / N, modulo 1.

Zaremba 1966, "Good lattice points, discrepancy, and numerical integration". The fractions F(k) / F(k-1) tend to the
golden ratio, which fractions approximate worst of all numbers, so the discrepancy is of order log N / N. The random
shift is a number of whole steps of 1/N plus a place within a step that all points share: the lattice stays exact.
"""

import numpy as np
from numpy.typing import NDArray

from samplekit import FibonacciNumbers, Realizations, Sampler
from samplekit.kernels import below, dimension_key, kernel, offset_bits, place_in_cell, second_key

_U64 = np.uint64
_CHUNK = 1024


@kernel("void(float64[:,:,::1], uint64[::1], uint64[::1], int64, uint64)")
def _fill(
    out: NDArray[np.float64],
    keys: NDArray[np.uint64],
    generators: NDArray[np.uint64],
    count: int,
    start: np.uint64,
) -> None:
    realizations, dims, points = out.shape
    modulus = _U64(count)
    bits = offset_bits(count)
    shift, step, width = _U64(64 - bits), 2.0 ** (-bits), 1.0 / count
    multiples = np.empty(min(points, _CHUNK), np.int64)
    for d in range(dims):
        generator = generators[d]
        for i in range(multiples.size):
            # All products here are below 2^64, since the count is at most 2^32.
            multiples[i] = np.int64(_U64(i) * generator % modulus)
        for r in range(realizations):
            key = dimension_key(keys[r], d)
            within = second_key(key)
            for first in range(0, points, multiples.size):
                origin = np.int64(((start + _U64(first)) * generator + below(key, modulus)) % modulus)
                row = out[r, d, first : min(first + multiples.size, points)]
                for i in range(row.size):
                    numerator = multiples[i] + origin
                    numerator = numerator - count if numerator >= count else numerator
                    row[i] = place_in_cell(np.float64(numerator), within, shift, step, width)


class Fibonacci(Sampler):
    """Fibonacci's lattice plus the realisation's random shift, modulo 1."""

    def fill(self, out: NDArray[np.float64], realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets; see :meth:`samplekit.Sampler.fill`."""
        # There is no number below 1, and one point needs no generator.
        generators = np.array((1, FibonacciNumbers().below(count, 2) or 0), np.uint64)
        _fill(out, realizations.keys, generators, count, _U64(start))
