"""Points as 64-bit fractions, where a shift modulo 1 is an addition that wraps."""

from __future__ import annotations

from typing import TYPE_CHECKING

from samplekit.numerics.kernel import kernel
from samplekit.sampling.hashing import unit

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from samplekit import Realizations


@kernel("void(float64[:,:,::1], uint64[:,::1], uint64[:,::1])")
def _add_shifts(out: NDArray[np.float64], fractions: NDArray[np.uint64], shifts: NDArray[np.uint64]) -> None:
    realizations, dims, points = out.shape
    for r in range(realizations):
        for d in range(dims):
            row = out[r, d]
            shift = shifts[r, d]
            for i in range(points):
                row[i] = unit(fractions[d, i] + shift)


def write_shifted(out: NDArray[np.float64], fractions: NDArray[np.uint64], realizations: Realizations) -> None:
    """Write ``fractions`` uint64[D, n] plus a random shift for each realisation and dimension: float64[R, D, n]."""
    _add_shifts(out, fractions, realizations.random_words(fractions.shape[0]))
