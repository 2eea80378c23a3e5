"""Sums of the rows of a matrix, in the fixed order of :func:`samplekit.kernels.lane_sum`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from samplekit.kernels._compile import kernel
from samplekit.kernels._sums import lane_sum

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


@kernel("void(float64[:,::1], float64[::1])")
def row_sums(values: NDArray[np.float64], out: NDArray[np.float64]) -> None:
    """Write the sum of each row of ``values`` float64[P, n], n <= 1024, into ``out`` float64[P]."""
    for row in range(values.shape[0]):
        out[row] = lane_sum(values[row], values.shape[1])
