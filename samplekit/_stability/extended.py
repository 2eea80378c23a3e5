"""Sums in double-double arithmetic, with which sums in float64 are compared.

Each addition has a relative error of at most 2^-104 (Joldes, Muller, Popescu 2017, algorithm 5): a sum of 1e9 values is
right to about 22 digits.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit.kernels import dd_add, kernel, two_product

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    Array = NDArray[np.float64]


@kernel("void(float64[:,::1], float64[:,::1])")
def _accumulate(values: Array, totals: Array) -> None:
    """Add the finite values float64[R, n] to the totals float64[R, 2], high and low parts."""
    for row in range(values.shape[0]):
        high, low = totals[row, 0], totals[row, 1]
        for i in range(values.shape[1]):
            if np.isfinite(values[row, i]):
                high, low = dd_add(high, low, values[row, i], 0.0)
        totals[row, 0], totals[row, 1] = high, low


@kernel("void(float64[:,::1], float64[::1], float64, float64[::1])")
def _compare(totals: Array, means: Array, count: float, apart: Array) -> None:
    """Write (count * mean - total) / count for each of the means float64[R]."""
    for row in range(means.size):
        product, low = two_product(means[row], count)
        apart[row] = dd_add(product, low, -totals[row, 0], -totals[row, 1])[0] / count


class ExtendedSums:
    """Sums of the values of several realisations, block by block."""

    def __init__(self, realizations: int) -> None:
        self._totals = np.zeros((realizations, 2))

    def add(self, parts: Sequence[Array]) -> None:
        """Add blocks of values float64[R, n]; values that are not finite are left out."""
        for values in parts:
            _accumulate(np.ascontiguousarray(values), self._totals)

    def mean(self, count: int) -> Array:
        """Return the means float64[R] of ``count`` values, rounded once."""
        return self._totals[:, 0] / count

    def apart(self, means: Array, count: int) -> Array:
        """Return the differences float64[R] of means of ``count`` values from these sums, without cancellation."""
        apart = np.empty(means.size)
        _compare(self._totals, np.ascontiguousarray(means), float(count), apart)
        return apart
