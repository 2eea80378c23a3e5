"""The R2 sequence in any dimension: multiples of powers of the generalised golden ratio, modulo 1.

Roberts 2018, "The unreasonable effectiveness of quasirandom sequences": in D dimensions phi is the root of
x^(D+1) = x + 1 and the step along axis d is phi^-(d+1). Steps are 64-bit fractions, so that products wrap exactly.
"""

from __future__ import annotations

from decimal import Decimal, localcontext
from typing import TYPE_CHECKING

import numpy as np

from samplekit import Sampler
from samplekit_lattice.fixed_point import shifted

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit import Realizations


def golden_steps(dims: int) -> NDArray[np.uint64]:
    """The steps phi^-1, ..., phi^-D as 64-bit fractions, uint64[D]."""
    with localcontext() as context:
        context.prec = 50
        phi = Decimal(2)
        for _ in range(200):
            phi = (phi + 1) ** (Decimal(1) / (dims + 1))
        return np.array([int(phi ** -(d + 1) * 2**64) for d in range(dims)], np.uint64)


class R2(Sampler):
    """Point i is i times the step plus the realisation's shift, modulo 1."""

    def fill(self, out: NDArray[np.float64], realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets; see :meth:`samplekit.Sampler.fill`."""
        _, dims, points = out.shape
        index = np.arange(start, start + points, dtype=np.uint64)
        out[:] = shifted(golden_steps(dims)[:, None] * index, realizations)
