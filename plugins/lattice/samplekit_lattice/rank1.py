"""Extensible rank-1 lattices: point i is phi_2(i) z, modulo 1, for a generating vector z and the radical inverse phi_2.

Hickernell, Hong, L'Ecuyer, Lemieux 2000, "Extensible lattice sequences for quasi-Monte Carlo quadrature": the first
N = 2^m points are the lattice k z / N, k = 0 to N - 1, in another order, and every later block of N points is that
lattice shifted. The files in the folder ``vectors`` say where the vectors come from.
"""

from dataclasses import replace
from functools import cache
from importlib import resources

import numpy as np
from numpy.typing import NDArray

from samplekit import Realizations, Sampler, SamplerSpec
from samplekit_lattice.shifted_multiples import fill_shifted_multiples

_KNOWN = {"hkkn": {"across-dimensions": "made for smooth periodic integrands: dimensions 5 and 7 are correlated"}}


@cache
def generating_vector(name: str) -> NDArray[np.uint64]:
    """Return the vector of this name, uint64[D], read-only."""
    text = resources.files("samplekit_lattice").joinpath(f"vectors/{name}.txt").read_text(encoding="utf-8")
    numbers = [int(number) for line in text.splitlines() if not line.startswith("#") for number in line.split()]
    vector = np.array(numbers, np.uint64)
    vector.flags.writeable = False
    return vector


class Rank1(Sampler):
    """A lattice sequence plus the realisation's random shift, modulo 1.

    Parameters
    ----------
    vector
        Name of the generating vector: ``ckn`` or ``hkkn``.
    """

    def __init__(self, vector: str = "ckn") -> None:
        self.name = vector
        self.vector = generating_vector(vector)

    def refine(self, spec: SamplerSpec) -> SamplerSpec:
        """Declare the dimensions of the vector, and the check that it is known to fail."""
        return replace(spec, dimensions=(1, self.vector.size), expected_failures=_KNOWN.get(self.name, {}))

    def fill(self, out: NDArray[np.float64], realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets; see :meth:`samplekit.Sampler.fill`."""
        dims = out.shape[1]
        fill_shifted_multiples(out, self.vector[:dims], realizations.random_words(dims), start, True)
