"""Strata: a random place in cell i of n equal cells of [0, 1), that lies in that cell in float64 too.

(i + r) / n reaches 1.0, and often the next cell, when r is close to 1 and the sum or the quotient rounds up.
Here r has so few bits that i + r is exact and stays farther from both ends of the cell than the quotient's rounding.
"""

import numpy as np

from samplekit.kernels._compile import helper
from samplekit.kernels._permutation import permutation_bits

_U64 = np.uint64


@helper
def offset_bits(cells: int) -> int:
    """Number of random bits that a place within one of ``cells`` cells has: 50 less the bits of the cell's index."""
    return 50 - permutation_bits(cells) if cells > 1 else 50


@helper
def place_in_cell(cell: float, random: np.uint64, shift: np.uint64, step: float, width: float) -> float:
    """A place in cell ``cell``: (cell + (r + 1/2) step) width, r the top bits of ``random``.

    ``shift`` is 64 - offset_bits(n), ``step`` is 2^-offset_bits(n), ``width`` is 1/n.
    """
    return (cell + (np.float64(random >> shift) + 0.5) * step) * width


@helper
def cell_along_axis(point: float, per_row: float, side: float, width: float) -> float:
    """The cell of an axis with ``side`` cells that point number ``point`` of a grid is in.

    ``per_row`` is 1 over the number of cells of the axes before, ``width`` is 1 / side. Integer division by way of
    float64, which vectorises: the half keeps clear of the rounding.
    """
    row = float(np.floor((point + 0.5) * per_row))
    return row - side * float(np.floor((row + 0.5) * width))
