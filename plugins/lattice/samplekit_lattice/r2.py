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
from samplekit.kernels import kernel
from samplekit_lattice.fixed_point import CHUNK, write_shifted

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit import Realizations

_U64 = np.uint64
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


@kernel("void(float64[:,:,::1], uint64[::1], uint64[:,::1], int64)")
def _fill(out: NDArray[np.float64], steps: NDArray[np.uint64], shifts: NDArray[np.uint64], start: int) -> None:
    _, dims, points = out.shape
    chunk = np.empty(CHUNK, np.uint64)
    for first in range(0, points, CHUNK):
        fractions = chunk[: min(CHUNK, points - first)]
        for d in range(dims):
            for i in range(fractions.size):
                fractions[i] = _U64(start + first + i) * steps[d]
            write_shifted(out, d, first, fractions, shifts)


class R2(Sampler):
    """Point i is i times the step plus the realisation's shift, modulo 1."""

    def fill(self, out: NDArray[np.float64], realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets; see :meth:`samplekit.Sampler.fill`."""
        dims = out.shape[1]
        _fill(out, golden_steps(dims).copy(), realizations.random_words(dims), start)
