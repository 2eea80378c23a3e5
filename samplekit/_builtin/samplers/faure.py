"""Faure's (0, s)-sequences: digital sequences in a prime base b, of the best quality t = 0 in up to b dimensions.

Faure 1982, "Discrépance de suites associées à un système de numération (en dimension s)", Acta Arithmetica 41. With the
digits a_0, a_1, ... of the index in base b, digit j + 1 of dimension d is the sum over r >= j of C(r, j) d^(r - j) a_r,
modulo b: the generator matrix is the d-th power of Pascal's. Indices start at 0; the first b points lie on the diagonal
unless they are scrambled.

The digits of i + j are those of i plus those of j, modulo b, where j is a multiple of a power of b that i is below: a
table of the first points, whose first digits alone are not 0, and a few additions for each later one.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from math import comb
from typing import TYPE_CHECKING

import numpy as np

from samplekit import Net, PowersOf, Sampler, UsageError
from samplekit.kernels import kernel, largest_power, table_size

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit import Realizations, SamplerSpec

_NET_DIMS = 5
"""Dimensions of the nets that are declared; those of all of them follow from t = 0."""


def _is_prime(n: int) -> bool:
    return all(n % divisor for divisor in range(2, n) if divisor * divisor <= n)


@cache
def generator_matrices(base: int, dims: int) -> NDArray[np.int64]:
    """C(r, j) d^(r - j) modulo the base, int64[D, K, K]: digit j of a point from digit r of its index."""
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
def _fill(out: NDArray[np.float64], matrices: NDArray[np.int64], base: int, start: int) -> None:
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
        A prime: as many dimensions as there can be.
    """

    def __init__(self, base: int = 5) -> None:
        if not _is_prime(base):
            below = next(n for n in range(base, 1, -1) if _is_prime(n))
            above = next(n for n in range(base, 2 * base) if _is_prime(n))
            raise UsageError(f"faure: option base={base}: expected a prime: the nearest are {below} and {above}")
        self.base = base

    def refine(self, spec: SamplerSpec) -> SamplerSpec:
        """As many dimensions as the base, and nets in it."""
        nets = {min(dims, self.base) for dims in (2, _NET_DIMS)}
        return replace(
            spec,
            dimensions=(1, self.base),
            progressive=PowersOf(self.base),
            promises=tuple(Net(dims=tuple(range(dims)), base=self.base) for dims in sorted(nets)),
        )

    def fill(self, out: NDArray[np.float64], realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets; see :meth:`Sampler.fill`."""
        _fill(out, generator_matrices(self.base, out.shape[1]), self.base, start)
        out[1:] = out[0]

    def bases(self, dims: int) -> tuple[int, ...]:
        """The base, in all dimensions."""
        return (self.base,) * dims
