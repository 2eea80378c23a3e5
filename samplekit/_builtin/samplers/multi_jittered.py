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
from samplekit.kernels import (
    SHUFFLED,
    dimension_key,
    hash_index,
    kernel,
    mix64,
    offset_bits,
    permutation_bits,
    permute_in_lines,
    permute_range,
    place_in_cell,
    second_key,
    shuffle,
)

Array = NDArray[np.float64]

_U64 = np.uint64
_ORDER = _U64(0xBB67AE8584CAA73B)
_LINES = _U64(0x3C6EF372FE94F82B)
_BLOCK = 1024
"""Number of points that are made at a time, so that their intermediate values stay in the cache."""
_TABULATED = 1 << 16
"""Largest table of shuffled places: the places of one line if all lines share them, else those of all lines."""


@kernel("void(float64[:,:,::1], uint64[::1], int64, int64, int64, int64, boolean)")
def _fill(
    out: Array, keys: NDArray[np.uint64], columns: int, rows: int, count: int, start: int, correlated: bool
) -> None:
    realizations, dims, whole = out.shape
    points = min(whole, _BLOCK)
    shuffled = count <= SHUFFLED
    places = np.empty(SHUFFLED, np.int64)
    tabulated = (max(columns, rows) if correlated else count) <= _TABULATED
    table = np.empty(max(columns, rows) if correlated else count if tabulated else 0, np.int64)
    place = np.empty(points, np.int64)
    order = np.empty(points, np.float64)
    line = np.empty(points, np.int64)
    line_keys = np.empty(max(columns, rows), np.uint64)
    bits = offset_bits(count)
    shift = _U64(64 - bits)
    step = 2.0 ** (-bits)
    width = 1.0 / count
    count_bits = permutation_bits(count)
    row_length = np.float64(columns)
    per_row = 1.0 / row_length
    for r in range(realizations):
        for d in range(dims):
            order_key = mix64(dimension_key(keys[r], d - d % 2) ^ _ORDER)
            if d > 1 and d % 2 == 0 and shuffled:
                shuffle(places, count, order_key)
            # Along x the lines are the columns, each with one sub-column per row; along y the reverse.
            lines, sublines = (columns, rows) if d % 2 == 0 else (rows, columns)
            key = dimension_key(keys[r], d)
            second = second_key(key)
            line_key = mix64(key ^ _LINES)
            subline_bits = permutation_bits(sublines)
            per_line = 0 if correlated else sublines
            if tabulated and correlated:
                shuffle(table, sublines, line_key)
            else:
                for k in range(lines):
                    line_keys[k] = line_key if correlated else mix64(line_key + _U64(k))
                    if tabulated:
                        shuffle(table[k * sublines :], sublines, line_keys[k])
            for begin in range(start, start + whole, points):
                n = min(points, start + whole - begin)
                if d < 2:
                    for i in range(n):
                        order[i] = np.float64(begin + i)
                elif shuffled:
                    for i in range(n):
                        order[i] = np.float64(places[begin + i])
                else:
                    permute_range(place[:n], begin, count, count_bits, order_key)
                    for i in range(n):
                        order[i] = np.float64(place[i])
                for i in range(n):
                    across = np.floor((order[i] + 0.5) * per_row)
                    column = order[i] - row_length * across
                    line[i] = np.int64(column if d % 2 == 0 else across)
                    place[i] = np.int64(across if d % 2 == 0 else column)
                if tabulated:
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
