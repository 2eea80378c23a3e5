"""Faure's (0, s)-sequences: digital sequences in a prime base b, of the best quality t = 0 in up to b dimensions.

Faure 1982, "Discrépance de suites associées à un système de numération (en dimension s)", Acta Arithmetica 41. With the
digits a_0, a_1, ... of the index in base b, digit j + 1 of dimension d is the sum over r >= j of C(r, j) d^(r - j) a_r,
modulo b: the generator matrix is the d-th power of Pascal's. Indices start at 0; the first b points lie on the diagonal
unless they are scrambled.

Where j is a multiple of a power of b, and i is below that power, the digits of point i + j are those of point i plus
those of point j, modulo b. So a table of the first points and a few additions give each later point.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from math import comb

import numpy as np
from numpy.typing import NDArray

from samplekit import Net, PowersOf, Realizations, Sampler, SamplerSpec, UsageError
from samplekit.kernels import kernel, largest_power, primes, table_size

Array = NDArray[np.float64]

_NET_DIMS = (2, 5)
"""Dimensions of the nets that are declared; that of all dimensions has t = 0 as well."""
_BASES = primes(172)
"""The primes up to 1021."""


@cache
def _generator_matrices(base: int, dims: int) -> NDArray[np.int64]:
    """Return C(r, j) d^(r - j) modulo the base, int64[D, K, K]: digit j of a point from digit r of its index."""
    places = 1
    while base ** (places + 1) <= 1 << 53:
        places += 1
    matrices = np.zeros((dims, places, places), np.int64)
    for d in range(dims):
        for r in range(places):
            for j in range(r + 1):
                matrices[d, j, r] = comb(r, j) * pow(d, r - j, base) % base
    matrices.flags.writeable = False
    return matrices


@kernel("void(float64[:,:,::1], Array(int64, 3, 'C', readonly=True), int64, int64)")
def _fill(out: Array, matrices: NDArray[np.int64], base: int, start: int) -> None:
    """Write the points start, start + 1, ... of the first realisation."""
    _, dims, points = out.shape
    places = matrices.shape[1]
    power = largest_power(base, 1 << 53)
    last = start + points - 1
    size = table_size(base, last)
    inner = 0
    reach = 1
    while reach < size:
        reach *= base
        inner += 1
    length = min(size, last + 1)
    b = np.float64(base)
    table = np.zeros((inner, length))
    beyond = np.empty(places, np.int64)
    numerator = np.empty(length)
    for d in range(dims):
        filled = 1
        for r in range(inner):
            for c in range(1, min(base, (length - 1) // filled + 1)):
                run = min(filled, length - c * filled)
                for j in range(inner):
                    step = np.float64(c * matrices[d, j, r] % base)
                    for i in range(run):
                        digit = table[j, i] + step
                        table[j, c * filled + i] = digit - b if digit >= b else digit
            filled *= base
            if filled >= length:
                break
        done = 0
        while done < points:
            block = (start + done) // size
            offset = start + done - block * size
            run = min(size - offset, points - done)
            beyond[:] = 0
            r = inner
            while block > 0:
                for j in range(r + 1):
                    beyond[j] += matrices[d, j, r] * (block % base)
                block //= base
                r += 1
            weight = power
            for i in range(run):
                numerator[i] = 0.0
            rest = 0.0
            for j in range(r):
                weight //= base
                added = np.float64(beyond[j] % base)
                if j < inner:
                    for i in range(run):
                        digit = table[j, offset + i] + added
                        digit = digit - b if digit >= b else digit
                        numerator[i] += digit * np.float64(weight)
                else:
                    rest += added * np.float64(weight)
            row = out[0, d, done : done + run]
            for i in range(run):
                row[i] = (numerator[i] + rest) / np.float64(power)
            done += run


class Faure(Sampler):
    """Faure's sequence in a prime base.

    Parameters
    ----------
    base
        A prime up to 1021, and the largest number of dimensions.

    Raises
    ------
    UsageError
        The base is not a prime: names the nearest.
    """

    def __init__(self, base: int = 5) -> None:
        if base not in _BASES:
            below = max(prime for prime in _BASES if prime < base)
            above = min(prime for prime in _BASES if prime > base)
            raise UsageError(f"faure: option base={base}: expected a prime: the nearest are {below} and {above}")
        self.base = base

    def refine(self, spec: SamplerSpec) -> SamplerSpec:
        """Declare as many dimensions as the base, and nets in the base."""
        nets = {min(dims, self.base) for dims in _NET_DIMS}
        return replace(
            spec,
            dimensions=(1, self.base),
            progressive=PowersOf(self.base),
            promises=tuple(Net(dims=tuple(range(dims)), base=self.base) for dims in sorted(nets)),
        )

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets; see :meth:`Sampler.fill`."""
        _fill(out, _generator_matrices(self.base, out.shape[1]), self.base, start)
        out[1:] = out[0]

    def bases(self, dims: int) -> tuple[int, ...]:
        """Return the base for each dimension."""
        return (self.base,) * dims
