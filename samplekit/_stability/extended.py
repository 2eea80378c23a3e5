"""Sums in double-double: what float64 sums are held against.

Every value is added exactly but for 2^-104 relative (Joldes, Muller, Popescu 2017, algorithm 5): of 1e9 values at
most the 22nd digit is lost.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit.kernels._compile import kernel
from samplekit.kernels._double_double import dd_add, two_product

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    Array = NDArray[np.float64]


@kernel("void(float64[:,::1], float64[:,::1])")
def _accumulate(values: Array, totals: Array) -> None:
    for row in range(values.shape[0]):
        high, low = totals[row, 0], totals[row, 1]
        for i in range(values.shape[1]):
            if np.isfinite(values[row, i]):
                high, low = dd_add(high, low, values[row, i], 0.0)
        totals[row, 0], totals[row, 1] = high, low


@kernel("void(float64[:,::1], float64[::1], float64, float64[::1])")
def _compare(totals: Array, means: Array, count: float, apart: Array) -> None:
    """Write count * mean - total, over count."""
    for row in range(means.size):
        product, low = two_product(means[row], count)
        apart[row] = dd_add(product, low, -totals[row, 0], -totals[row, 1])[0] / count


class ExtendedSums:
    """Sums of the values of R realisations in double-double, block after block."""

    def __init__(self, realizations: int) -> None:
        self._totals = np.zeros((realizations, 2))

    def add(self, parts: Sequence[Array]) -> None:
        """Add blocks of values float64[R, n]; those that are not finite are left out."""
        for values in parts:
            _accumulate(np.ascontiguousarray(values), self._totals)

    def mean(self, count: int) -> Array:
        """The means float64[R], rounded once."""
        return self._totals[:, 0] / count

    def apart(self, means: Array, count: int) -> Array:
        """How far means float64[R] of ``count`` values are from these sums, without cancellation: float64[R]."""
        apart = np.empty(means.size)
        _compare(self._totals, np.ascontiguousarray(means), float(count), apart)
        return apart
