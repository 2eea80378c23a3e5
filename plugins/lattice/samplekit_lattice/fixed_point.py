"""Points as 64-bit fractions, where a shift modulo 1 is an addition that wraps."""

from __future__ import annotations

from typing import TYPE_CHECKING

from samplekit.kernels import helper, unit

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

CHUNK = 1024
"""Points whose fractions are made at a time, for all realisations: so few that they stay in the fastest cache."""


@helper
def write_shifted(
    out: NDArray[np.float64], dimension: int, first: int, fractions: NDArray[np.uint64], shifts: NDArray[np.uint64]
) -> None:
    """Write points first, first + 1, ... of a dimension: ``fractions`` plus the shift of each realisation.

    ``out`` float64[R, D, n], ``fractions`` uint64[k], ``shifts`` uint64[R, D].
    """
    for r in range(out.shape[0]):
        row = out[r, dimension, first : first + fractions.size]
        shift = shifts[r, dimension]
        for i in range(fractions.size):
            row[i] = unit(fractions[i] + shift)
