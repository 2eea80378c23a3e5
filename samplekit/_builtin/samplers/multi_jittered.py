"""Multi-jittered sampling: jittered in 2D and Latin in each dimension at once.

Chiu, Shirley, Wang 1994, "Multi-jittered sampling", Graphics Gems IV, shuffle every column and every row on its own.
Kensler 2013, "Correlated multi-jittered sampling", Pixar 13-01, takes one permutation for all columns and one for all
rows, which lowers the variance of smooth integrands from N^-2 to N^-3.

Beyond two dimensions, pairs of dimensions are padded: each pair is a set of its own, visited in a random order.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from samplekit import Realizations, Sampler, UsageError, grid_sides
from samplekit._builtin.samplers.strata import (
    BLOCK,
    cell_steps,
    new_lines,
    new_places,
    ordered_places,
)
from samplekit.kernels import (
    dimension_key,
    hash_index,
    kernel,
    mix64,
    permutation_bits,
    permute_in_lines,
    place_in_cell,
    second_key,
    shuffle,
)

Array = NDArray[np.float64]

_U64 = np.uint64
_ORDER = _U64(0xBB67AE8584CAA73B)
_LINES = _U64(0x3C6EF372FE94F82B)


@kernel("void(float64[:,:,::1], uint64[::1], int64, int64, int64, int64, boolean)")
def _fill(
    out: Array, keys: NDArray[np.uint64], columns: int, rows: int, count: int, start: int, correlated: bool
) -> None:
    realizations, dims, whole = out.shape
    points = min(whole, BLOCK)
    places = new_places(points, count)
    line_keys, table = new_lines(max(columns, rows), max(columns, rows) if correlated else count)
    place, line, order = np.empty(points, np.int64), np.empty(points, np.int64), np.empty(points)
    count_bits = permutation_bits(count)
    shift, step, width = cell_steps(count)
    row_length = np.float64(columns)
    per_row = 1.0 / row_length
    for r in range(realizations):
        for d in range(dims):
            order_key = mix64(dimension_key(keys[r], d - d % 2) ^ _ORDER)
            # Along x the lines are the columns, each with one sub-column per row; along y the reverse.
            lines, sublines = (columns, rows) if d % 2 == 0 else (rows, columns)
            key = dimension_key(keys[r], d)
            second = second_key(key)
            subline_bits = permutation_bits(sublines)
            per_line = 0 if correlated else sublines
            line_key = mix64(key ^ _LINES)
            if correlated and table.size > 0:
                shuffle(table, sublines, line_key)
            else:
                for k in range(lines):
                    line_keys[k] = line_key if correlated else mix64(line_key + _U64(k))
                    if table.size > 0:
                        shuffle(table[k * sublines :], sublines, line_keys[k])
            for begin in range(start, start + whole, points):
                n = min(points, start + whole - begin)
                # The second dimension of a pair finds the order of the first, unless another block came between.
                if d < 2:
                    for i in range(n):
                        order[i] = np.float64(begin + i)
                elif d % 2 == 0 or whole > points:
                    ordered = ordered_places(places, n, count, begin, count_bits, order_key)
                    for i in range(n):
                        order[i] = np.float64(ordered[i])
                for i in range(n):
                    across = np.floor((order[i] + 0.5) * per_row)
                    column = order[i] - row_length * across
                    line[i] = np.int64(column if d % 2 == 0 else across)
                    place[i] = np.int64(across if d % 2 == 0 else column)
                if table.size > 0:
                    for i in range(n):
                        place[i] = table[line[i] * per_line + place[i]]
                else:
                    permute_in_lines(place[:n], line[:n], sublines, subline_bits, line_keys)
                row = out[r, d, begin - start : begin - start + n]
                for i in range(n):
                    cell = np.float64(line[i] * sublines + place[i])
                    row[i] = place_in_cell(cell, hash_index(key, second, _U64(begin + i)), shift, step, width)


class MultiJittered(Sampler):
    """Every column and every row is shuffled on its own."""

    correlated = False

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets; see :meth:`Sampler.fill`."""
        sides = grid_sides(count, 2)
        if sides is None:
            raise UsageError(f"{count} points do not form a grid of near-equal sides")
        _fill(out, realizations.keys, sides[0], sides[1], count, start, self.correlated)


class CorrelatedMultiJittered(MultiJittered):
    """All columns share one permutation, and all rows another."""

    correlated = True
