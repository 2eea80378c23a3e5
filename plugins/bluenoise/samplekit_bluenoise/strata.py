"""Jittered points for any count: N strata of equal area, each nearly a square, and their division into four.

The strata form about sqrt(N) rows. The height of a row is its share of the strata, and the strata of a row are equally
wide, so that any N will do.
"""

import math

import numpy as np
from numpy.typing import NDArray

from samplekit.kernels import TWO_M32, hash_index, helper, kernel, second_key

Array = NDArray[np.float64]

_U64 = np.uint64


@helper
def _rows(strata: int) -> int:
    return max(1, int(np.rint(math.sqrt(strata))))


@helper
def _place(bits: np.uint64) -> float:
    """Return 32 bits as a number at least 2^-33 from 0 and 1: rounding keeps it in its stratum."""
    return (np.float64(bits) + 0.5) * TWO_M32


@kernel("void(float64[:,::1], uint64)")
def scatter(points: Array, key: np.uint64) -> None:
    """Write a random place in each of N strata: ``points`` float64[2, N]."""
    count = points.shape[1]
    rows = _rows(count)
    second = second_key(key)
    for row in range(rows):
        first = row * count // rows
        width = (row + 1) * count // rows - first
        for i in range(first, first + width):
            bits = hash_index(key, second, _U64(i))
            points[0, i] = (i - first + _place(bits >> _U64(32))) / width
            points[1, i] = (first + _place(bits & _U64(0xFFFFFFFF)) * width) / count


@kernel("void(float64[:,::1], float64[:,::1], int64, uint64)")
def split(finer: Array, points: Array, splits: int, key: np.uint64) -> None:
    """Write four points for each point, one in each quarter of its stratum.

    Parameters
    ----------
    finer
        float64[2, 4 N]: receives the points 4 i to 4 i + 3 for point i.
    points
        float64[2, N], one in each stratum, in any order.
    splits
        How often the strata were split before.
    key
        Key of the random places.
    """
    count = points.shape[1]
    strata = count >> (2 * splits)
    rows = _rows(strata)
    parts = 1 << splits
    second = second_key(key)
    for k in range(count):
        x = points[0, k]
        # The row of the unsplit strata whose span, from first / strata to (first + width) / strata, holds y.
        y = points[1, k] * strata
        row = int(points[1, k] * rows)
        while row * strata // rows > y:
            row -= 1
        while (row + 1) * strata // rows <= y:
            row += 1
        first = row * strata // rows
        width = (row + 1) * strata // rows - first
        column = np.floor(x * width * parts)
        line = np.floor((y - first) / width * parts)
        for quarter in range(4):
            bits = hash_index(key, second, _U64(4 * k + quarter))
            finer[0, 4 * k + quarter] = (2.0 * column + (quarter & 1) + _place(bits >> _U64(32))) / (2 * parts * width)
            finer[1, 4 * k + quarter] = (
                first + (2.0 * line + (quarter >> 1) + _place(bits & _U64(0xFFFFFFFF))) / (2 * parts) * width
            ) / strata
