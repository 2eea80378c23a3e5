"""Digital nets in base 2: points from the bits of their index and one generator matrix per dimension.

Sobol' 1967, "On the distribution of points in a cube and the approximate evaluation of integrals"; Niederreiter 1987.
"""

import numpy as np
from numpy.typing import NDArray

from samplekit.kernels._compile import helper

_U32 = np.uint32

BITS = 32
"""Digits of a coordinate; indices run from 0 to 2^32 - 1."""


@helper
def net_coordinates(out: NDArray[np.uint32], columns: NDArray[np.uint32], start: int) -> None:
    """Write the coordinates, as 32-bit fractions, of the points start, start + 1, ... of one dimension.

    ``columns`` uint32[32]: column j of the generator matrix belongs to bit j of the index, its top bit to digit 1.
    """
    points = out.size
    for i in range(points):
        out[i] = _U32(0)
    last = start + points - 1
    bit = 0
    while (last >> bit) > 0:
        column = columns[bit]
        for i in range(points):
            chosen = _U32(((start + i) >> bit) & 1)
            out[i] ^= _U32(column * chosen)
        bit += 1
