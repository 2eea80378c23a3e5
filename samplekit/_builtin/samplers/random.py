"""Independent uniform points: white noise, to which all other samplers are compared."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from samplekit import Realizations, Sampler
from samplekit.kernels import dimension_key, hash_index, kernel, second_key, unit

Array = NDArray[np.float64]

_U64 = np.uint64


@kernel("void(float64[:,:,::1], uint64[::1], int64)")
def _fill(out: Array, keys: NDArray[np.uint64], start: int) -> None:
    realizations, dims, points = out.shape
    for r in range(realizations):
        for d in range(dims):
            key = dimension_key(keys[r], d)
            second = second_key(key)
            row = out[r, d]
            for i in range(points):
                row[i] = unit(hash_index(key, second, _U64(start + i)))


class Random(Sampler):
    """Counter-based random points: point i is a hash of (seed, realisation, dimension, i)."""

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets; see :meth:`Sampler.fill`."""
        _fill(out, realizations.keys, start)
