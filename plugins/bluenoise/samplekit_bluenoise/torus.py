"""The unit torus: differences of coordinates, the densest packing, and the coordinates of finished sets.

Coordinates of finished sets are multiples of 2^-53 in [0, 1). So reflections, and shifts by such multiples, are exact
in float64: they move a set without changing the last bit of any distance.
"""

import math

import numpy as np
from numpy.typing import NDArray

from samplekit.kernels import helper, kernel, shuffle

Array = NDArray[np.float64]

_GRID = 2.0**53
_STEP = 2.0**-53


def packing_distance(count: int) -> float:
    """Return the distance of neighbours in the densest packing of N points per unit area: sqrt(2 / (sqrt(3) N))."""
    return math.sqrt(2.0 / (math.sqrt(3.0) * count))


@helper
def wrapped(difference: float) -> float:
    """Return the shortest of the differences that are equal modulo 1, in [-1/2, 1/2]."""
    return float(difference - np.rint(difference))


@helper
def on_torus(x: float) -> float:
    """Return ``x`` modulo 1, rounded down to a multiple of 2^-53 in [0, 1)."""
    multiple = np.floor((x - np.floor(x)) * _GRID)
    # x - floor(x) is 1 for a tiny negative x.
    return (multiple if multiple < _GRID else 0.0) * _STEP


@helper
def sort_into_cells(points: Array) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Sort ``points`` float64[2, N] into a grid with about as many cells as points.

    Returns
    -------
    head
        int64[side, side]: the first point of the cell in (row, column), or -1.
    following
        int64[N]: the next point of the same cell, or -1.
    """
    count = points.shape[1]
    side = max(1, int(math.sqrt(count)))
    head = np.empty((side, side), np.int64)
    head[:] = -1
    following = np.empty(count, np.int64)
    for i in range(count):
        column = int(points[0, i] * side)
        row = int(points[1, i] * side)
        following[i] = head[row, column]
        head[row, column] = i
    return head, following


@kernel("void(float64[:,::1], float64[:,::1], uint64)")
def finish(out: Array, points: Array, key: np.uint64) -> None:
    """Write ``points`` float64[2, N] to ``out`` float64[2, N] modulo 1, in a random order."""
    count = points.shape[1]
    place = np.empty(count, np.int64)
    shuffle(place, count, key)
    for d in range(2):
        for i in range(count):
            out[d, i] = on_torus(points[d, place[i]])
