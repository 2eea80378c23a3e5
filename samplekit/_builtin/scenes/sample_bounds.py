"""Bounds of what kernels compute at the samples of a pixel, rounding included: how scenes prove that it is constant.

Every operation of those kernels is monotone, rounded or not: the first and the last sample of an interval bound all.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Bounds = tuple[Array, Array]


def sample_bounds(edges: Array) -> Bounds:
    """Return the least and the largest sample of each interval between ``edges`` float64[n + 1]: float64[n] each."""
    first = np.asarray(edges[:-1], np.float64)
    # The slack is for widths that the renderer rounded in another way than here.
    return first, np.maximum(first + np.diff(edges) * (1.0 + 2.0**-50), edges[1:])


def product_bounds(factor: float, bounds: Bounds) -> Bounds:
    """Bound the product of ``factor`` and a number between ``bounds``."""
    ends = factor * bounds[0], factor * bounds[1]
    return np.minimum(*ends), np.maximum(*ends)


def square_bounds(low: Array, high: Array) -> Bounds:
    """Bound the square of a number from ``low`` to ``high``."""
    near = np.where((low <= 0.0) & (high >= 0.0), 0.0, np.minimum(abs(low), abs(high)))
    far = np.maximum(abs(low), abs(high))
    with np.errstate(over="ignore"):
        return near * near, far * far
