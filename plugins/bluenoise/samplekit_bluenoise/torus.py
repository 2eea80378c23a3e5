"""The unit torus: differences of coordinates, the densest packing, and the coordinates of finished sets.

Coordinates of finished sets are multiples of 2^-53 in [0, 1). So reflections, and shifts by such multiples, are exact
in float64: they move a set without changing the last bit of any distance.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from samplekit.kernels import helper, kernel, shuffle

if TYPE_CHECKING:
    from numpy.typing import NDArray

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
def sort_into_cells(points: Array, side: int, head: NDArray[np.int64], following: NDArray[np.int64]) -> None:
    """Sort ``points`` float64[2, N] into a grid of ``side`` cells along each axis.

    The points of cell (column, row) form a linked list: head[row * side + column] is the first, following[i] is the one
    after i, and -1 ends the list.
    """
    head[: side * side] = -1
    for i in range(points.shape[1]):
        cell = int(points[1, i] * side) * side + int(points[0, i] * side)
        following[i] = head[cell]
        head[cell] = i


@kernel("void(float64[:,::1], float64[:,::1], uint64)")
def finish(out: Array, points: Array, key: np.uint64) -> None:
    """Write ``points`` float64[2, N] to ``out`` float64[2, N] modulo 1, in a random order."""
    count = points.shape[1]
    place = np.empty(count, np.int64)
    shuffle(place, count, key)
    for d in range(2):
        for i in range(count):
            out[d, i] = on_torus(points[d, place[i]])
