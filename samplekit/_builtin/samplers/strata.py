"""Strata in random order, for the samplers that place one point in each of many cells."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit.kernels import SHUFFLED, helper, offset_bits, permute_range, shuffle

if TYPE_CHECKING:
    from numpy.typing import NDArray

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
def new_lines(lines: int, places: int) -> tuple[NDArray[np.uint64], NDArray[np.int64]]:
    """Return the keys of lines, and the table of all their ``places``, both to be written.

    ``places`` are those of one line if all lines share their order. The table is empty where it would be too large.
    """
    return np.empty(lines, np.uint64), np.empty(places if places <= _TABULATED else 0, np.int64)
