"""In which cell of n equal cells of [0, 1) a float64 lies, exactly.

A boundary c/n is rarely a float64, and a sampler's exact value k/b^j is not either: what it can give is the float64
nearest to k/b^j. So the boundary here is the float64 nearest to c/n, which is what dividing two integers below 2^53
gives. Rounding is monotone: an exact value at or above c/n never rounds to less than the rounded boundary, so a sampler
that computes its digits in integers and divides once is always judged right, and one that adds up digits in floating
point and ends below the boundary is not.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray


def cell_of(x: NDArray[np.float64], cells: int) -> NDArray[np.int64]:
    """The cell 0 to cells - 1 of each coordinate; coordinates outside [0, 1) get the nearest cell.

    Exact for ``cells`` below 2^31: the product is within one of the cell, and comparing with both boundaries mends it.
    """
    cell = np.clip(x * cells, 0, cells - 1).astype(np.int64)
    cell -= x < cell / cells
    cell += x >= (cell + 1) / cells
    return np.clip(cell, 0, cells - 1)


def ulps_below(x: NDArray[np.float64], cells: int) -> NDArray[np.float64]:
    """How many units in the last place each coordinate lies below the next boundary."""
    boundary = (cell_of(x, cells) + 1) / cells
    distance: NDArray[np.float64] = (boundary - x) / np.spacing(x)
    return distance
