"""Sums in a fixed order: the same bits in any tile and on any number of threads.

Inside a block of at most 1024 values eight lanes are summed side by side; blocks are combined pairwise
(Higham 2002, "Accuracy and Stability of Numerical Algorithms", 4.2).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit.numerics.kernel import helper

if TYPE_CHECKING:
    from numpy.typing import NDArray

BLOCK = 1024
"""Number of samples whose sum a scene gives at once."""


@helper
def lane_sum(values: NDArray[np.float64], count: int) -> float:
    """The sum of the first ``count`` values, in eight lanes."""
    a = b = c = d = e = f = g = h = 0.0
    whole = count - count % 8
    for i in range(0, whole, 8):
        a += values[i]
        b += values[i + 1]
        c += values[i + 2]
        d += values[i + 3]
        e += values[i + 4]
        f += values[i + 5]
        g += values[i + 6]
        h += values[i + 7]
    rest = 0.0
    for i in range(whole, count):
        rest += values[i]
    return (((a + b) + (c + d)) + ((e + f) + (g + h))) + rest


class PairwiseSum:
    """Sums of many rows at once, block after block, combined pairwise.

    Keeps one partial sum per level of the binary tree: memory grows with the logarithm of the number of blocks.
    """

    def __init__(self) -> None:
        self._levels: list[NDArray[np.float64] | None] = []

    def add(self, block_sums: NDArray[np.float64]) -> None:
        """Add the sums float64[P] of the next block."""
        carry = block_sums.copy()
        for level, partial in enumerate(self._levels):
            if partial is None:
                self._levels[level] = carry
                return
            carry = partial + carry
            self._levels[level] = None
        self._levels.append(carry)

    def total(self) -> NDArray[np.float64]:
        """The sums float64[P] of all blocks so far."""
        partials = [partial for partial in self._levels if partial is not None]
        result = partials[0].copy()
        for partial in partials[1:]:
            result = partial + result
        return result
