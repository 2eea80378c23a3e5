"""Strata in random order, for the samplers that place one point in each of many cells."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from samplekit.kernels import (
    SHUFFLED,
    hash_index,
    helper,
    mix64,
    offset_bits,
    permute_in_lines,
    permute_range,
    place_in_cell,
    second_key,
    shuffle,
)

Array = NDArray[np.float64]

_U64 = np.uint64
BLOCK = 1024
"""Number of points that are made at a time, so that their intermediate values stay in the cache."""
_TABULATED = 1 << 16
"""Largest table of shuffled places: the places of one line if all lines share them, else those of all lines."""


@helper
def new_places(points: int, count: int) -> NDArray[np.int64]:
    """Return workspace for :func:`ordered_places`."""
    return np.empty(max(points, min(count, SHUFFLED)), np.int64)


@helper
def ordered_places(
    places: NDArray[np.int64], points: int, count: int, start: int, bits: int, key: np.uint64
) -> NDArray[np.int64]:
    """Return the places that points start, start + 1, ... have in a random order of all ``count``: int64[points].

    ``places`` is workspace, of which the result is a part; ``bits`` is permutation_bits(count).
    """
    if count <= SHUFFLED:
        shuffle(places, count, key)
        return places[start : start + points]
    permute_range(places[:points], start, count, bits, key)
    return places[:points]


@helper
def write_in_cells(row: Array, cells: Array | NDArray[np.int64], count: int, start: int, key: np.uint64) -> None:
    """Write a random place in each point's cell, one of ``count`` equal cells of [0, 1).

    ``start`` is the number of the first point, ``key`` the dimension's.
    """
    second = second_key(key)
    bits = offset_bits(count)
    shift, step, width = _U64(64 - bits), 2.0 ** (-bits), 1.0 / count
    for i in range(row.size):
        row[i] = place_in_cell(np.float64(cells[i]), hash_index(key, second, _U64(start + i)), shift, step, width)


@helper
def new_lines(lines: int, places: int) -> tuple[NDArray[np.uint64], NDArray[np.int64]]:
    """Return the keys of lines, and the table of all their ``places``, for :func:`shuffle_lines` to write.

    ``places`` are those of one line if all lines share their order. The table is empty where it would be too large.
    """
    return np.empty(lines, np.uint64), np.empty(places if places <= _TABULATED else 0, np.int64)


@helper
def shuffle_lines(
    keys: NDArray[np.uint64], table: NDArray[np.int64], lines: int, sublines: int, shared: bool, key: np.uint64
) -> None:
    """Give each line a random order of its ``sublines`` places: one order for all lines if it is ``shared``."""
    for line in range(1 if shared and table.size > 0 else lines):
        keys[line] = key if shared else mix64(key + _U64(line))
        if table.size > 0:
            shuffle(table[line * sublines :], sublines, keys[line])


@helper
def permute_in_shuffled_lines(
    places: NDArray[np.int64],
    lines: NDArray[np.int64],
    sublines: int,
    shared: bool,
    bits: int,
    keys: NDArray[np.uint64],
    table: NDArray[np.int64],
) -> None:
    """Take each place to where the order of its line has it, in place; ``bits`` is permutation_bits(sublines)."""
    per_line = 0 if shared else sublines
    if table.size > 0:
        for i in range(places.size):
            places[i] = table[lines[i] * per_line + places[i]]
    else:
        permute_in_lines(places, lines, sublines, bits, keys)
