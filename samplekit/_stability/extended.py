"""Sums in double-double arithmetic, with which sums in float64 are compared.

Each addition has a relative error of at most 2^-104 (Joldes, Muller, Popescu 2017, algorithm 5): a sum of 1e9 values is
right to about 22 digits.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit.kernels import dd_add, kernel, two_product

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]


@kernel("void(float64[:,::1], float64[:,::1])")
def accumulate(values: Array, totals: Array) -> None:
    """Add the finite values float64[R, n] to the totals float64[R, 2], of which each has a high and a low part."""
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


def distances(means: Array, totals: Array, count: int) -> Array:
    """Return float64[R]: how far means of ``count`` values lie above those of the totals, without cancellation."""
    apart = np.empty(means.size)
    _compare(totals, np.ascontiguousarray(means), float(count), apart)
    return apart
