"""A rank-1 lattice: point i is i z / N, modulo 1, for a generating vector z.

The vector is that of Cools, Kuo, Nuyens 2006, "Constructing embedded lattice rules for multivariate integration",
order 2: good for every N = 2^m up to 2^20 and in all two-dimensional projections.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit import Sampler
from samplekit_lattice.fixed_point import shifted

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit import Realizations

GENERATING_VECTOR = np.array(
    [
        1,
        182667,
        469891,
        498753,
        110745,
        446247,
        250185,
        118627,
        245333,
        283199,
        408519,
        391023,
        246327,
        126539,
        399185,
        461527,
    ],
    np.uint64,
)


class Rank1(Sampler):
    """A lattice of N = 2^m points with the realisation's shift."""

    def fill(self, out: NDArray[np.float64], realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets; see :meth:`samplekit.Sampler.fill`."""
        _, dims, points = out.shape
        index = np.arange(start, start + points, dtype=np.uint64)
        # N divides 2^64: in 64-bit fractions i z / N modulo 1 is a product that wraps.
        step = GENERATING_VECTOR[:dims] * np.uint64(2**64 // count % 2**64)
        out[:] = shifted(step[:, None] * index, realizations)
