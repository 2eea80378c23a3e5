"""The order of pixels along Morton's curve, the four quadrants visited in a random order at every node.

Morton 1966, "A computer oriented geodetic data base"; Ahmed and Wonka 2020, "Screen-space blue-noise diffusion of Monte
Carlo sampling error via hierarchical ordering of pixels", ACM TOG 39(6).
"""

from __future__ import annotations

from itertools import permutations
from typing import TYPE_CHECKING

import numpy as np

from samplekit.numerics.kernel import helper
from samplekit.sampling.hashing import below, hash_index, second_key

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

_U64 = np.uint64


def _complementary(order: Sequence[int]) -> bool:
    """Whether pixels above each other differ in bit 0 of their place, and pixels side by side in the sum of its bits.

    Those are the first digits of x and y in Sobol's sequence: the two points then lie in different halves of x, or of
    y, which is the coordinate that decides where an upright edge, or a level one, runs through both pixels.
    """
    halves = [(place & 1, (place & 1) ^ (place >> 1)) for place in order]
    return (
        halves[0][0] != halves[2][0]
        and halves[1][0] != halves[3][0]
        and (halves[0][1] != halves[1][1] and halves[2][1] != halves[3][1])
    )


ALL_ORDERS = np.array(list(permutations(range(4))), np.int64)
"""int64[24, 4]: the place of each quadrant x + 2 y."""
COMPLEMENTARY_ORDERS = np.array([order for order in permutations(range(4)) if _complementary(order)], np.int64)
"""int64[12, 4]: the half of them in which neighbours complement each other."""


@helper
def place_of_pixel(x: int, y: int, levels: int, key: np.uint64, orders: NDArray[np.int64]) -> int:
    """The place of pixel (x, y), coordinates below 2^L, among 4^L pixels.

    Every aligned square of 4^k pixels has 4^k successive places. ``key`` chooses one of ``orders`` for each square.
    """
    second = second_key(key)
    square, place = 1, 0
    for level in range(levels - 1, -1, -1):
        quadrant = ((x >> level) & 1) + 2 * ((y >> level) & 1)
        order = below(hash_index(key, second, _U64(square)), _U64(orders.shape[0]))
        place = 4 * place + orders[order, quadrant]
        square = 4 * square + quadrant
    return place
