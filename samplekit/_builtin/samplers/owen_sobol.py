"""Owen-scrambled and shuffled Sobol points in blocks of four dimensions.

Burley 2020, "Practical hash-based Owen scrambling", JCGT 9(4). The first four dimensions of Sobol's sequence are among
the best: t is 0 in the first two, at most e_i - 1 + e_j - 1 in a pair whose polynomials have the degrees e_i and e_j,
and 3 in all four (Sobol' 1967). Every block uses these four again, instead of later dimensions with a larger t.
"""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import NDArray

from samplekit import Realizations, Sampler
from samplekit._builtin.samplers.sobol import direction_numbers
from samplekit.kernels import fill_padded, group_tables

Array = NDArray[np.float64]


@cache
def _tables() -> NDArray[np.uint32]:
    return group_tables(direction_numbers(4))


class OwenSobol(Sampler):
    """Any number of dimensions; each block of four is scrambled and shuffled on its own."""

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets; see :meth:`Sampler.fill`."""
        fill_padded(out, realizations.keys, _tables(), start, 0)
