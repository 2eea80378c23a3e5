"""Lattice sequences as 64-bit fractions: products and sums modulo 1 are those of integers that wrap around."""

import numpy as np
from numpy.typing import NDArray

from samplekit.kernels import kernel, reverse_bits32, unit

_U64 = np.uint64
_U32 = np.uint32
_CHUNK = 1024
"""Number of points that are made at a time for all realisations: so few that they stay in the fastest cache."""


@kernel("void(float64[:,:,::1], Array(uint64, 1, 'C', readonly=True), uint64[:,::1], int64, boolean)")
def fill_shifted_multiples(
    out: NDArray[np.float64], steps: NDArray[np.uint64], shifts: NDArray[np.uint64], start: int, mirrored: bool
) -> None:
    """Write points start, start + 1, ...: multiples of a step plus the shift of the realisation, modulo 1.

    Parameters
    ----------
    out
        float64[R, D, n].
    steps
        uint64[D]: the step along each axis, in units of 2^-64.
    shifts
        uint64[R, D]: the shifts, in units of 2^-64.
    start
        Index of the first point.
    mirrored
        Point i is i times the step, or with ``mirrored`` phi_2(i) times the step, where phi_2 mirrors the 32 bits of
        the index at the binary point and the step is a whole number.
    """
    realizations, dims, points = out.shape
    multiples, fractions = np.empty(_CHUNK, np.uint64), np.empty(_CHUNK, np.uint64)
    for first in range(0, points, _CHUNK):
        count = min(_CHUNK, points - first)
        for i in range(count):
            index = start + first + i
            multiples[i] = _U64(reverse_bits32(_U32(index))) << _U64(32) if mirrored else _U64(index)
        for d in range(dims):
            for i in range(count):
                fractions[i] = multiples[i] * steps[d]
            for r in range(realizations):
                row = out[r, d, first : first + count]
                shift = shifts[r, d]
                for i in range(count):
                    row[i] = unit(fractions[i] + shift)
