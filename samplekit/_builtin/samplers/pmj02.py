"""Progressive multi-jittered (0, 2)-sequences, pmj02.

Christensen, Kensler, Kilpatrick 2018, "Progressive multi-jittered sample sequences", EGSR; Helmer, Christensen, Kensler
2021, "Stochastic generation of (t, s) sample sequences", EGSR. The supplement of the latter makes them point by point:
the first digits of a point are those of an earlier point exclusive-ored with a constant, a column of a generator
matrix; the digits after them are random.

The order in which pmj02 fills the square determines the matrices. For N = 4^k, point N + i lies in the cell of point i
on the 2^k x 2^k grid, in the opposite quadrant. For N = 2 4^k it lies in that cell with one coordinate in the other
half, here x and y by turns. The random digits are a hashed Owen scrambling of the digital sequence, so that any point
can be computed alone. Points made one after the other with fresh random digits have the same distribution, as the paper
shows.
"""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import NDArray

from samplekit import Realizations, Sampler
from samplekit.kernels import BITS, fill_padded, group_tables, reverse_bits32

Array = NDArray[np.float64]


def pmj02_columns() -> NDArray[np.uint32]:
    """Return the columns of the generator matrices U and P U, where P is Pascal's matrix modulo 2: uint32[2, 32].

    The identity and P generate a (0, 2)-sequence. An upper triangular U on the right changes only the order within each
    prefix of 2^m points. Column m of U is the u with u_m = 1 and no later digits for which the first k = m // 2 digits
    of u and of P u are 0; for odd m this leaves a choice, and the next digit of one of the two is 0 as well.
    """
    columns = np.zeros((2, BITS), np.uint32)
    for m in range(BITS):
        k = m // 2
        wanted_x, wanted_y = k, k
        if m % 2:
            # x moves at m = 1, 5, ..., y at m = 3, 7, ...
            wanted_x, wanted_y = (k, k + 1) if k % 2 == 0 else (k + 1, k)
        u = _solve(m, wanted_x, wanted_y)
        columns[:, m] = [reverse_bits32(np.uint32(digits)) for digits in (u, _pascal(u))]
    return columns


def _pascal(u: int) -> int:
    """Return P u for digits u, with digit r in bit r: (P u)_r is the sum of C(c, r) u_c."""
    # C(c, r) is odd where the bits of r are among those of c (Lucas 1878).
    return sum((sum(u >> c & 1 for c in range(BITS) if c & r == r) & 1) << r for r in range(BITS))


def _solve(m: int, zeros_x: int, zeros_y: int) -> int:
    """Return the u = 2^m + lower bits whose first ``zeros_x`` digits, and the first ``zeros_y`` of P u, are 0."""
    # Gauss-Jordan elimination over the field of two elements on the bits below m; bit m is the right side.
    rows = [1 << r for r in range(zeros_x)]
    rows += [sum(1 << c for c in range(m + 1) if c & r == r) for r in range(zeros_y)]
    u = 1 << m
    pivots: list[tuple[int, int]] = []
    for row in rows:
        reduced = row
        for bit, pivot in pivots:
            if reduced >> bit & 1:
                reduced ^= pivot
        unknowns = reduced & ((1 << m) - 1)
        bit = unknowns.bit_length() - 1
        pivots = [(b, p ^ reduced if p >> bit & 1 else p) for b, p in pivots]
        pivots.append((bit, reduced))
    for bit, pivot in pivots:
        u |= (pivot >> m & 1) << bit
    return u


@cache
def _tables() -> NDArray[np.uint32]:
    return group_tables(pmj02_columns())


class Pmj02(Sampler):
    """Pairs of dimensions: the first in the order of pmj02, the others shuffled so that prefixes stay nets."""

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets; see :meth:`Sampler.fill`."""
        fill_padded(out, realizations.keys, _tables(), start, 2)
