"""Rank-1 lattices that grow: point i is phi_2(i) z, modulo 1, for a generating vector z and the radical inverse phi_2.

Hickernell, Hong, L'Ecuyer, Lemieux 2000, "Extensible lattice sequences for quasi-Monte Carlo quadrature": the first
N = 2^m points are the lattice k z / N, k = 0 to N - 1, in another order, and every later block of N points is that
lattice shifted. The vectors, with where they come from, are in the folder ``vectors``.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from importlib import resources
from typing import TYPE_CHECKING

import numpy as np

from samplekit import Sampler
from samplekit.kernels import kernel, reverse_bits32
from samplekit_lattice.fixed_point import CHUNK, write_shifted

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit import Realizations, SamplerSpec

_U64 = np.uint64
_U32 = np.uint32
_KNOWN = {"hkkn": {"across-dimensions": "made for smooth periodic integrands: dimensions 5 and 7 are correlated"}}


@cache
def generating_vector(name: str) -> NDArray[np.uint64]:
    """The vector of this name, uint64[D]; not to be written to."""
    text = resources.files("samplekit_lattice").joinpath(f"vectors/{name}.txt").read_text(encoding="utf-8")
    numbers = [int(number) for line in text.splitlines() if not line.startswith("#") for number in line.split()]
    vector = np.array(numbers, np.uint64)
    vector.flags.writeable = False
    return vector


@kernel("void(float64[:,:,::1], uint64[::1], uint64[:,::1], int64)")
def _fill(out: NDArray[np.float64], vector: NDArray[np.uint64], shifts: NDArray[np.uint64], start: int) -> None:
    _, dims, points = out.shape
    chunk = np.empty(CHUNK, np.uint64)
    for first in range(0, points, CHUNK):
        fractions = chunk[: min(CHUNK, points - first)]
        for d in range(dims):
            for i in range(fractions.size):
                # The product of z and phi_2(i) as a 64-bit fraction wraps modulo 1.
                fractions[i] = (_U64(reverse_bits32(_U32(start + first + i))) << _U64(32)) * vector[d]
            write_shifted(out, d, first, fractions, shifts)


class Rank1(Sampler):
    """A lattice sequence with the realisation's shift."""

    def __init__(self, vector: str = "ckn") -> None:
        self.name = vector
        self.vector = generating_vector(vector)

    def refine(self, spec: SamplerSpec) -> SamplerSpec:
        """As many dimensions as the vector has, and what is known of them."""
        return replace(spec, dimensions=(1, self.vector.size), expected_failures=_KNOWN.get(self.name, {}))

    def fill(self, out: NDArray[np.float64], realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets; see :meth:`samplekit.Sampler.fill`."""
        dims = out.shape[1]
        _fill(out, self.vector[:dims].copy(), realizations.random_words(dims), start)
