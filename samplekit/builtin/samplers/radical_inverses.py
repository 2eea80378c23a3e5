"""Van der Corput, Halton and Hammersley points: radical inverses of the index in prime bases.

Halton 1960, "On the efficiency of certain quasi-random sequences of points in evaluating multi-dimensional
integrals"; Hammersley 1960, "Monte Carlo methods for solving multivariable problems". Indices start at 0, so that no
coordinate is 1.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from samplekit.sampling.radical_inverse import primes, radical_inverses
from samplekit.sampling.sampler import Sampler
from samplekit.specs import Net

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit.sampling.realizations import Realizations
    from samplekit.specs import SamplerSpec


class Halton(Sampler):
    """Dimension d is the radical inverse of the index in the (d + 1)-th prime."""

    def fill(self, out: NDArray[np.float64], realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets; see :meth:`Sampler.fill`."""
        for dimension, base in enumerate(self.bases(out.shape[1])):
            radical_inverses(out[0, dimension], base, start)
        out[1:] = out[0]

    def bases(self, dims: int) -> tuple[int, ...]:
        """The first ``dims`` primes."""
        return primes(dims)


class VanDerCorput(Halton):
    """The radical inverse of the index in one base."""

    def __init__(self, base: int = 2) -> None:
        self.base = base

    def refine(self, spec: SamplerSpec) -> SamplerSpec:
        """Blocks of powers of the base are nets in it."""
        return replace(spec, promises=(Net(dims=(0,), base=self.base),))

    def bases(self, dims: int) -> tuple[int, ...]:
        """The base, for the one dimension."""
        return (self.base,) * dims


class Hammersley(Halton):
    """Dimension 0 is index / count, dimension d the radical inverse in the d-th prime."""

    def fill(self, out: NDArray[np.float64], realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets; see :meth:`Sampler.fill`."""
        _, dims, points = out.shape
        out[0, 0] = np.arange(start, start + points) / count
        for dimension, base in enumerate(primes(dims - 1), start=1):
            radical_inverses(out[0, dimension], base, start)
        out[1:] = out[0]

    def bases(self, dims: int) -> tuple[int, ...]:
        """Base 2 for index / count, then the primes."""
        return (2, *primes(dims - 1))
