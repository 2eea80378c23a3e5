"""Multi-jittered sampling: jittered in 2D and Latin in each dimension at once.

``MultiJittered``: Chiu, Shirley, Wang 1994, "Multi-jittered sampling", Graphics Gems IV; every column and every row is
shuffled on its own. ``CorrelatedMultiJittered``: Kensler 2013, "Correlated multi-jittered sampling", Pixar 13-01; one
permutation for all columns and one for all rows, which takes the variance of smooth integrands from N^-2 to N^-3.

Beyond two dimensions, pairs of dimensions are padded: each pair is a set of its own, visited in a random order.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit.counts import grid_sides
from samplekit.errors import UsageError
from samplekit.numerics.kernel import kernel
from samplekit.sampling.hashing import dimension_key, hash_index, mix64, second_key
from samplekit.sampling.permutation import SHUFFLED, permutation_bits, permute, shuffle
from samplekit.sampling.sampler import Sampler
from samplekit.sampling.stratification import offset_bits, place_in_cell

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit.sampling.realizations import Realizations

_U64 = np.uint64
_ORDER = _U64(0xBB67AE8584CAA73B)
_LINES = _U64(0x3C6EF372FE94F82B)


@kernel("void(float64[:,:,::1], uint64[::1], int64, int64, int64, int64, boolean)")
def _fill(
    out: NDArray[np.float64],
    keys: NDArray[np.uint64],
    columns: int,
    rows: int,
    count: int,
    start: int,
    correlated: bool,
) -> None:
    realizations, dims, points = out.shape
    shuffled = count <= SHUFFLED
    order = np.empty(points, np.int64)
    table = np.empty(SHUFFLED, np.int64)
    within = np.empty(SHUFFLED, np.int64)
    bits = offset_bits(count)
    shift = _U64(64 - bits)
    step = 2.0 ** (-bits)
    width = 1.0 / count
    count_bits = permutation_bits(count)
    for r in range(realizations):
        for d in range(dims):
            pair_key = dimension_key(keys[r], d - d % 2)
            if d % 2 == 0:
                if d == 0:
                    for i in range(points):
                        order[i] = start + i
                elif shuffled:
                    shuffle(table, count, mix64(pair_key ^ _ORDER))
                    for i in range(points):
                        order[i] = table[start + i]
                else:
                    for i in range(points):
                        order[i] = permute(start + i, count, count_bits, mix64(pair_key ^ _ORDER))
            # Along x the lines are the columns, each with one sub-column per row; along y the reverse.
            lines, sublines = (columns, rows) if d % 2 == 0 else (rows, columns)
            key = dimension_key(keys[r], d)
            second = second_key(key)
            line_key = mix64(key ^ _LINES)
            subline_bits = permutation_bits(sublines)
            if shuffled:
                if correlated:
                    shuffle(within, sublines, line_key)
                else:
                    for line in range(lines):
                        shuffle(within[line * sublines :], sublines, mix64(line_key + _U64(line)))
            row = out[r, d]
            for i in range(points):
                column, across = order[i] % columns, order[i] // columns
                line, other = (column, across) if d % 2 == 0 else (across, column)
                if shuffled:
                    subline = within[other] if correlated else within[line * sublines + other]
                elif correlated:
                    subline = permute(other, sublines, subline_bits, line_key)
                else:
                    subline = permute(other, sublines, subline_bits, mix64(line_key + _U64(line)))
                cell = np.float64(line * sublines + subline)
                row[i] = place_in_cell(cell, hash_index(key, second, _U64(start + i)), shift, step, width)


class _MultiJittered(Sampler):
    correlated: bool

    def fill(self, out: NDArray[np.float64], realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets; see :meth:`Sampler.fill`."""
        sides = grid_sides(count, 2)
        if sides is None:
            raise UsageError(f"{count} points do not form a grid of near-equal sides")
        _fill(out, realizations.keys, sides[0], sides[1], count, start, self.correlated)


class MultiJittered(_MultiJittered):
    """Every column and every row shuffled on its own."""

    correlated = False


class CorrelatedMultiJittered(_MultiJittered):
    """One permutation for all columns, one for all rows."""

    correlated = True
