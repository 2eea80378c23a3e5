"""The R2 sequence in any dimension: multiples of powers of the generalised golden ratio, modulo 1.

Roberts 2018, "The unreasonable effectiveness of quasirandom sequences": in D dimensions phi is the root above 1 of
x^(D+1) = x + 1, and the step along axis d is phi^-(d+1). Steps are 64-bit fractions, so that products wrap exactly; a
step is off by at most 2^-65, so point 2^32 is off by at most 2^-33 in any dimension.
"""

from __future__ import annotations

from decimal import Decimal, localcontext
from functools import cache
from typing import TYPE_CHECKING

import numpy as np

from samplekit import Sampler
from samplekit_lattice.fixed_point import write_shifted

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit import Realizations

_DIGITS = 60
"""Decimal digits of phi: 20 make a 64-bit fraction, and D powers lose log10(D) of the rest."""


@cache
def golden_steps(dims: int) -> NDArray[np.uint64]:
    """The steps phi^-1, ..., phi^-D as the nearest 64-bit fractions, uint64[D]; not to be written to."""
    with localcontext() as context:
        context.prec = _DIGITS
        # Newton's method on a convex function: from either side it comes down to the root, doubling its digits.
        phi = Decimal(2 ** (1 / (dims + 1)))
        for _ in range(12):
            power = phi**dims
            phi -= (power * phi - phi - 1) / ((dims + 1) * power - 1)
        step = Decimal(1)
        steps = []
        for _ in range(dims):
            step /= phi
            steps.append(int((step * 2**64).to_integral_value()))
    found = np.array(steps, np.uint64)
    found.flags.writeable = False
    return found


class R2(Sampler):
    """Point i is i times the step plus the realisation's shift, modulo 1."""

    def fill(self, out: NDArray[np.float64], realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets; see :meth:`samplekit.Sampler.fill`."""
        _, dims, points = out.shape
        index = np.arange(start, start + points, dtype=np.uint64)
        write_shifted(out, golden_steps(dims)[:, None] * index, realizations)
