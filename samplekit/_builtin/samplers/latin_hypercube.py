"""Latin hypercube sampling: in every dimension one point in each of N equal intervals.

McKay, Beckman, Conover 1979, "A comparison of three methods for selecting values of input variables". In two dimensions
it is N-rooks sampling (Shirley 1991, "Discrepancy as a quality measure for sample distributions").
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from samplekit import Realizations, Sampler
from samplekit._builtin.samplers.strata import cell_steps, new_places, ordered_places
from samplekit.kernels import dimension_key, hash_index, kernel, mix64, permutation_bits, place_in_cell, second_key

Array = NDArray[np.float64]

_U64 = np.uint64
_SHUFFLE = _U64(0x6A09E667F3BCC908)


@kernel("void(float64[:,:,::1], uint64[::1], int64, int64)")
def _fill(out: Array, keys: NDArray[np.uint64], count: int, start: int) -> None:
    realizations, dims, points = out.shape
    places = new_places(points, count)
    bits = permutation_bits(count)
    shift, step, width = cell_steps(count)
    for r in range(realizations):
        for d in range(dims):
            key = dimension_key(keys[r], d)
            cells = ordered_places(places, points, count, start, bits, mix64(key ^ _SHUFFLE))
            second = second_key(key)
            row = out[r, d]
            for i in range(points):
                random = hash_index(key, second, _U64(start + i))
                row[i] = place_in_cell(np.float64(cells[i]), random, shift, step, width)


class LatinHypercube(Sampler):
    """A random place in each of N intervals, in a random order of its own in each dimension."""

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets; see :meth:`Sampler.fill`."""
        _fill(out, realizations.keys, count, start)
