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
def cell_steps(count: int) -> tuple[np.uint64, float, float]:
    """Return the shift, step and width that :func:`samplekit.kernels.place_in_cell` takes for ``count`` cells."""
    bits = offset_bits(count)
    return _U64(64 - bits), 2.0 ** (-bits), 1.0 / count


@helper
def write_in_cells(
    row: Array, cells: Array | NDArray[np.int64], steps: tuple[np.uint64, float, float], start: int, key: np.uint64
) -> None:
    """Write a random place in each point's cell of [0, 1); ``steps`` are those of :func:`cell_steps`.

    ``start`` is the number of the first point, ``key`` the dimension's.
    """
    second = second_key(key)
    shift, step, width = steps
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
    points: int,
    sublines: int,
    shared: bool,
    bits: int,
    keys: NDArray[np.uint64],
    table: NDArray[np.int64],
) -> None:
    """Take the first ``points`` places to where the orders of their lines have them, in place.

    ``bits`` is permutation_bits(sublines); ``sublines``, ``shared``, ``keys`` and ``table`` as for
    :func:`shuffle_lines`.
    """
    per_line = 0 if shared else sublines
    if table.size > 0:
        for i in range(points):
            places[i] = table[lines[i] * per_line + places[i]]
    else:
        permute_in_lines(places[:points], lines[:points], sublines, bits, keys)
