"""Cranley-Patterson rotation: one random toroidal shift of the whole set, also called homogenisation.

Cranley and Patterson 1976, "Randomization of number theoretic methods for multiple integration". Sums are rounded, so
distances change by up to 2^-52.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from samplekit import Randomizer, Realizations
from samplekit.kernels import dimension_key, kernel, mix64, unit

Array = NDArray[np.float64]

_SHIFT = np.uint64(0x1F83D9ABFB41BD6B)


@kernel("void(float64[:,:,::1], uint64[::1])")
def _apply(points: Array, keys: NDArray[np.uint64]) -> None:
    realizations, dims, count = points.shape
    for r in range(realizations):
        for d in range(dims):
            shift = unit(mix64(dimension_key(keys[r], d) ^ _SHIFT))
            row = points[r, d]
            for i in range(count):
                # Both terms are multiples of 2^-53 or finer and below 1: the sum is below 2 even when it is rounded.
                moved = row[i] + shift
                row[i] = moved - 1.0 if moved >= 1.0 else moved


class Shift(Randomizer):
    """Adds a uniform random vector to every point, modulo 1."""

    def apply(self, points: Array, realizations: Realizations, bases: tuple[int, ...]) -> None:
        """Shift ``points`` in place; see :meth:`Randomizer.apply`."""
        _apply(points, realizations.keys)
