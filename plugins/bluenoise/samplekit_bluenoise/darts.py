"""Dart throwing in time linear in the number of points: random sequential addition of disks on the torus.

At first darts go anywhere. When they begin to fail, a list is made of the square cells where a dart may still be
accepted; a dart then goes to a random place in a random cell of the list. All cells of the list have the same size, and
disks cover the rest of the square, so that the accepted darts have exactly the distribution of darts thrown at the
whole square. When these darts begin to fail too, every cell is split into four, and the quarters that a single disk
covers leave the list.

The idea is that of Jones 2006, "Efficient generation of Poisson-disk sampling patterns", and White, Cline, Egbert
2007, "Poisson disk point sets by hierarchical dart throwing", with cells of one size at a time as in Ebeida et al.
2012, "A simple algorithm for maximal Poisson-disk sampling in high dimensions".

Disks placed at random jam when they cover 0.547 of the plane (Feder 1980), at a distance near 0.835 / sqrt(N). A set
that jams before its last point is thrown away whole and begun anew.

Coordinates are 32-bit fractions: their differences wrap around by themselves, and a large set takes half the memory.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from samplekit.kernels import TWO_M32, below, dimension_key, hash_index, helper, kernel, second_key

Array = NDArray[np.float64]

_U64 = np.uint64

MOST_ATTEMPTS = 100
"""Number of sets begun for one realisation before giving up."""
_MISSES_ANYWHERE = 14.0
"""Failed darts per cell of the grid before the list is made. This and the next number affect only the time."""
_MISSES_IN_LIST = 0.7
"""Failed darts per cell of the list before the cells are split."""
_HANDFUL = 32
"""Number of darts that are drawn together."""
_SPLITS = 16
"""Number of splits after which a set counts as jammed: cells 2^-16 as wide as the grid's have hardly any area left."""
_NEAR = np.array([(0, 0), (1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (1, -1), (-1, 1), (-1, -1)])
"""Steps to a cell itself and to the cells around it, nearest first, where a conflict is most likely."""
_MARGIN = 2.0**-30
"""Cells are wider than the distance by a few of the smallest fractions, to which darts are rounded in their cells."""
_ROW = 32
_COLUMN = 2**_ROW - 1
_ONE = 2.0**32


class _Disks(NamedTuple):
    """The disks that were placed, and for each cell of the grid a linked list of those in it."""

    points: NDArray[np.uint32]
    """The centres, uint32[N, 2]."""
    head: NDArray[np.int32]
    """The last disk of the cell in (row, column), or -1."""
    following: NDArray[np.int32]
    """The disk that was placed in the same cell before, or -1."""


@helper
def _cells_per_axis(count: int, distance: float) -> int:
    """Return the side of a grid whose cells are no narrower than the distance: conflicts lie in 3 x 3 cells.

    The side is 1 where fewer than 3 cells would fit; where the distance is small there are about as many cells as
    points.
    """
    side = int(min(1.0 / (distance + _MARGIN), np.ceil(math.sqrt(count))))
    return side if side >= 3 else 1


@helper
def _wrapped(difference: np.int64) -> np.float64:
    """Return the shortest of the differences that are equal modulo 2^32."""
    return np.float64(((difference + 2**31) & 0xFFFFFFFF) - 2**31)


@helper
def _around(cell: np.int64, step: np.int64, side: int) -> np.int64:
    """Return the cell ``step`` cells further along an axis of the torus, -1 <= step <= 1."""
    moved = cell + step
    return moved + side if moved < 0 else moved - side if moved >= side else moved


@helper
def _place_if_free(
    x: np.int64, y: np.int64, column: np.int64, row: np.int64, least: float, placed: int, disks: _Disks
) -> int:
    """Place a disk at (x, y), in cell (column, row), unless one is closer than the root of ``least``.

    Return the new number of disks; ``placed`` is the number before.
    """
    side = disks.head.shape[0]
    for k in range(9 if side > 1 else 1):
        i = _around(column, _NEAR[k, 0], side)
        j = _around(row, _NEAR[k, 1], side)
        p = disks.head[j, i]
        while p >= 0:
            dx = _wrapped(x - disks.points[p, 0])
            dy = _wrapped(y - disks.points[p, 1])
            if dx * dx + dy * dy < least:
                return placed
            p = disks.following[p]
    disks.points[placed, 0] = x
    disks.points[placed, 1] = y
    disks.following[placed] = disks.head[row, column]
    disks.head[row, column] = placed
    return placed + 1


@helper
def _split(
    cell: np.int64, splits: int, width: float, least: float, disks: _Disks, cells: NDArray[np.int64], kept: int
) -> int:
    """Append the quarters of a cell that no single disk covers to the first ``kept`` of ``cells``.

    The cell was split ``splits`` times; quarters are ``width`` wide. Return the new number of cells.
    """
    side = disks.head.shape[0]
    column = cell & _COLUMN
    row = cell >> _ROW
    x = np.int64((2 * column + 1) * width)
    y = np.int64((2 * row + 1) * width)
    covered = np.int64(0)
    for k in range(9 if side > 1 else 1):
        i = _around(column >> splits, _NEAR[k, 0], side)
        j = _around(row >> splits, _NEAR[k, 1], side)
        p = disks.head[j, i]
        while p >= 0:
            # A quarter is covered if its farthest corner is. Across the torus these distances are too large, which only
            # leaves a covered quarter in the list.
            dx = _wrapped(disks.points[p, 0] - x)
            dy = _wrapped(disks.points[p, 1] - y)
            left = max(abs(dx), abs(dx + width)) ** 2
            right = max(abs(dx), abs(dx - width)) ** 2
            upper = max(abs(dy), abs(dy + width)) ** 2
            lower = max(abs(dy), abs(dy - width)) ** 2
            covered |= (left + upper < least) | (right + upper < least) << 1
            covered |= (left + lower < least) << 2 | (right + lower < least) << 3
            p = disks.following[p]
        if covered == 15:
            return kept
    for quarter in range(4):
        if not (covered >> quarter) & 1:
            cells[kept] = ((2 * row + (quarter >> 1)) << _ROW) | (2 * column + (quarter & 1))
            kept += 1
    return kept


@kernel("int64(float64[:,:,::1], uint64[::1], float64)")
def throw_darts(out: Array, keys: NDArray[np.uint64], distance: float) -> int:
    """Write sets of points no two of which are closer than ``distance``, in the order in which they were accepted.

    Parameters
    ----------
    out
        float64[R, 2, N].
    keys
        uint64[R].
    distance
        Smallest distance of two points on the torus.

    Returns
    -------
    The number of realisations that were written: fewer than R if one jammed in all its attempts.
    """
    realizations, _, count = out.shape
    least = (distance * _ONE) ** 2
    side = _cells_per_axis(count, distance)
    head = np.empty((side, side), np.int32)
    disks = _Disks(np.empty((count, 2), np.uint32), head, np.empty(count, np.int32))
    handful = np.empty((_HANDFUL, 3), np.int64)
    for r in range(realizations):
        placed = 0
        for attempt in range(MOST_ATTEMPTS):
            key = dimension_key(keys[r], 2 * attempt)
            second = second_key(key)
            head[:] = -1
            placed = 0
            thrown = 0
            most = _MISSES_ANYWHERE * side * side
            while placed < count and thrown - placed <= most:
                for k in range(_HANDFUL):
                    bits = hash_index(key, second, _U64(thrown + k))
                    x = np.int64(bits >> _U64(32))
                    y = np.int64(bits & _U64(0xFFFFFFFF))
                    handful[k, 0] = x
                    handful[k, 1] = y
                    # The value is not used; reading it fetches the cells of the whole handful from memory together.
                    handful[k, 2] = head[(y * side) >> 32, (x * side) >> 32]
                thrown += _HANDFUL
                for k in range(_HANDFUL):
                    x = handful[k, 0]
                    y = handful[k, 1]
                    if placed < count:
                        placed = _place_if_free(x, y, (x * side) >> 32, (y * side) >> 32, least, placed, disks)
            if placed == count:
                break
            width = _ONE / side
            active = side * side
            cells = np.empty(active, np.int64)
            for k in range(active):
                cells[k] = (k // side) << _ROW | (k % side)
            key_cell = dimension_key(keys[r], 2 * attempt + 1)
            second_cell = second_key(key_cell)
            for splits in range(1, _SPLITS + 1):
                width *= 0.5
                quarters = np.empty(4 * active, np.int64)
                kept = 0
                for k in range(active):
                    kept = _split(cells[k], splits - 1, width, least, disks, quarters, kept)
                cells = quarters
                active = kept
                misses = 0
                while placed < count and active > 0 and misses <= _MISSES_IN_LIST * active:
                    pick = np.int64(below(hash_index(key_cell, second_cell, _U64(thrown)), _U64(active)))
                    bits = hash_index(key, second, _U64(thrown))
                    thrown += 1
                    column = cells[pick] & _COLUMN
                    row = cells[pick] >> _ROW
                    x = np.int64((column + np.float64(bits >> _U64(32)) * TWO_M32) * width)
                    y = np.int64((row + np.float64(bits & _U64(0xFFFFFFFF)) * TWO_M32) * width)
                    before = placed
                    placed = _place_if_free(x, y, column >> splits, row >> splits, least, placed, disks)
                    misses += placed == before
                # With random numbers the list never grows so long; with constant ones, as a check makes them, it may.
                if placed == count or active > 4 * side * side:
                    break
            if placed == count:
                break
        if placed < count:
            return r
        for d in range(2):
            for i in range(count):
                out[r, d, i] = disks.points[i, d] * TWO_M32
    return int(realizations)
