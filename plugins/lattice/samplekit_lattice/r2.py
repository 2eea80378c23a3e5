"""The R2 sequence in any dimension: multiples of powers of the generalised golden ratio, modulo 1.

Roberts 2018, "The unreasonable effectiveness of quasirandom sequences": in D dimensions phi is the root above 1 of
x^(D+1) = x + 1, and the step along axis d is phi^-(d+1). Steps are 64-bit fractions, so that products wrap around
exactly; the error of a step is at most 2^-65, that of point 2^32 at most 2^-33 in any dimension.
"""

from decimal import Decimal, localcontext
from functools import cache

import numpy as np
from numpy.typing import NDArray

from samplekit import Realizations, Sampler
from samplekit_lattice.shifted_multiples import fill_shifted_multiples

_DIGITS = 60
"""Decimal digits of phi: a 64-bit fraction takes 20, and D powers lose log10(D) of the others."""


@cache
def golden_steps(dims: int) -> NDArray[np.uint64]:
    """Return the steps phi^-1, ..., phi^-D as the nearest 64-bit fractions, uint64[D], read-only."""
    with localcontext() as context:
        context.prec = _DIGITS
        # Newton's method on a convex function: it falls to the root and doubles the number of right digits each time.
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
        dims = out.shape[1]
        fill_shifted_multiples(out, golden_steps(dims), realizations.random_words(dims), start, False)
