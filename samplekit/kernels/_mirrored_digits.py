"""Radical inverses: the digits of the index mirrored at the point, plain or permuted at each place.

Van der Corput 1935; Halton 1960. Permutations at each place: a random shift of the digits (L'Ecuyer and Lemieux 2002,
"Recent advances in randomized quasi-Monte Carlo methods", section 5), or a uniformly random permutation of them (Owen
2017, "A randomized Halton algorithm in R").

Numerators stay integers until one correctly rounded division, so no value reaches 1 and none drifts. The mirrored
digits of i + j are the sum of those of i and of j where j is a multiple of a power of the base that i is below: a table
of the first points, and one addition for each later one.
"""

import numpy as np
from numpy.typing import NDArray

from samplekit.kernels._compile import helper, kernel, reverse_bits32
from samplekit.kernels._digits import DIGITS_LIMIT, largest, largest_power, tail_digits
from samplekit.kernels._hashing import (
    TWO_M32,
    TWO_M53,
    below,
    dimension_key,
    hash_index,
    mix64,
    random_below,
    second_key,
)

_U64 = np.uint64
_U32 = np.uint32
_DIGITS = _U64(0x5BE0CD19137E2179)
_ORDER = _U64(0x1F83D9ABFB41BD6B)
TABLE = 2048
"""Points of a table, at most, or the base where that is larger."""
_MOST_PLACES = 53
"""Number of digits of the largest index, in base 2."""
PLAIN = 0
"""Mode of :func:`fill_mirrored`: the digits as they are."""
SHIFTED = 1
"""Mode of :func:`fill_mirrored`: one random shift of the digits for each place."""
PERMUTED = 2
"""Mode of :func:`fill_mirrored`: one random permutation of the digits for each place."""


@helper
def table_size(base: int, last: int) -> int:
    """A power of the base, at least the base, that is at most ``TABLE`` or just above the index ``last``."""
    size = base
    while size * base <= TABLE and size <= last:
        size *= base
    return size


@helper
def shift_key(key: np.uint64, dimension: int) -> np.uint64:
    """The key of a dimension's digits."""
    return mix64(dimension_key(key, dimension) ^ _DIGITS)


@helper
def shift_numerator(key: np.uint64, power: int) -> int:
    """Return the shift of all digits together as a uniform integer below ``power``."""
    return int(random_below(key, np.float64(power)))


@helper
def _shuffle_first(order: NDArray[np.int64], base: int, wanted: int, key: np.uint64) -> None:
    """The first ``wanted`` of a random permutation of 0 to base - 1 that keeps 0 (Durstenfeld 1964)."""
    for c in range(base):
        order[c] = c
    second = second_key(key)
    for c in range(1, wanted):
        other = c + np.int64(below(hash_index(key, second, _U64(c)), _U64(base - c)))
        order[c], order[other] = order[other], order[c]


@kernel("void(float64[:,:,::1], uint64[::1], int64[::1], int64, int64)")
def fill_mirrored(
    out: NDArray[np.float64], keys: NDArray[np.uint64], bases: NDArray[np.int64], start: int, mode: int
) -> None:
    """Write the points start, start + 1, ...; dimension d has the base ``bases[d]``.

    ``mode`` is one of three. ``PLAIN``: the digits as they are; indices are below 2^53 / base, and keys are not used.
    ``SHIFTED``: digit c at place j becomes s_j + c modulo the base; indices are below 2^32. ``PERMUTED``: the same with
    a random permutation of c in the place of c.
    """
    realizations, dims, points = out.shape
    last = start + points - 1
    largest_base = largest(bases)
    table = np.empty(min(max(TABLE, largest_base), last + 1))
    steps = np.empty((_MOST_PLACES, min(largest_base, last + 1)))
    order = np.empty(largest_base, np.int64)
    for c in range(largest_base):
        order[c] = c
    for d in range(dims):
        base = bases[d]
        if base == 2 and mode != PLAIN:
            for r in range(realizations):
                word = shift_key(keys[r], d) >> _U64(11)
                upper = _U32(word >> _U64(21))
                tail = np.float64(word & _U64(0x1FFFFF)) * TWO_M53
                for i in range(points):
                    out[r, d, i] = np.float64(reverse_bits32(_U32(start + i)) ^ upper) * TWO_M32 + tail
            continue
        power = largest_power(base, (1 << 53) if mode == PLAIN else DIGITS_LIMIT)
        denominator = np.float64(power)
        size = table_size(base, last)
        length = min(size, last + 1)
        for r in range(realizations):
            key = shift_key(keys[r], d)
            root = 0 if mode == PLAIN else shift_numerator(key, power)
            weight = power
            rest = root
            place = 0
            reach = 1
            while reach <= last:
                weight //= base
                origin = rest // weight
                rest -= origin * weight
                used = min(base, last // reach + 1)
                reach *= base
                if mode == PERMUTED:
                    _shuffle_first(order, base, used, mix64(key ^ _ORDER) + _U64(place))
                for c in range(used):
                    image = origin + order[c]
                    if image >= base:
                        image -= base
                    steps[place, c] = np.float64((image - origin) * weight)
                place += 1
            table[0] = np.float64(root)
            filled = 1
            inner = 0
            while filled < length:
                for c in range(1, min(base, (length - 1) // filled + 1)):
                    step = steps[inner, c]
                    for i in range(min(filled, length - c * filled)):
                        table[c * filled + i] = table[i] + step
                filled *= base
                inner += 1
            past = 0.0 if mode == PLAIN else tail_digits(key, power)
            done = 0
            while done < points:
                block = (start + done) // size
                offset = start + done - block * size
                run = min(size - offset, points - done)
                beyond = past
                place = inner
                while block > 0:
                    beyond += steps[place, block % base]
                    block //= base
                    place += 1
                row = out[r, d, done : done + run]
                for i in range(run):
                    row[i] = (table[offset + i] + beyond) / denominator
                done += run
