"""Random digital shift: one random digit is added at each place, modulo the base (an exclusive or in base 2).

L'Ecuyer and Lemieux 2002, "Recent advances in randomized quasi-Monte Carlo methods", section 5; Kollig and Keller 2002.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from samplekit import Randomizer, Realizations
from samplekit.kernels import (
    DIGITS_LIMIT,
    TWO_M53,
    helper,
    kernel,
    largest_power,
    moved_digit,
    numerator,
    shift_key,
    shift_numerator,
    tail_digits,
)

Array = NDArray[np.float64]

_U64 = np.uint64
_TWO_P53 = 2.0**53
_CHUNK = 1024


@helper
def _shift_digits(row: Array, key: np.uint64, base: int, power: int, work: Array) -> None:
    """Shift at most ``work.shape[1]`` coordinates; ``work`` float64[2, K] is workspace."""
    rest, shifted = work
    b = np.float64(base)
    per_base = 1.0 / b
    largest = 0.0
    for i in range(row.size):
        rest[i] = np.float64(numerator(row[i], power))
        shifted[i] = 0.0
        largest = max(largest, rest[i])
    shift = shift_numerator(key, power)
    weight = power
    while largest > 0.0:
        weight //= base
        w = np.float64(weight)
        per_weight = 1.0 / w
        added = np.float64(shift // weight)
        shift %= weight
        largest = 0.0
        for i in range(row.size):
            digit = np.floor((rest[i] + 0.5) * per_weight)
            rest[i] -= digit * w
            shifted[i] += moved_digit(digit, added, b, per_base) * w
            largest = max(largest, rest[i])
    tail = tail_digits(key, power)
    for i in range(row.size):
        row[i] = (shifted[i] + np.float64(shift) + tail) / np.float64(power)


@kernel("void(float64[:,:,::1], uint64[::1], int64[::1])")
def _apply(points: Array, keys: NDArray[np.uint64], bases: NDArray[np.int64]) -> None:
    realizations, dims, count = points.shape
    work = np.empty((2, min(count, _CHUNK)))
    for d in range(dims):
        base = bases[d]
        power = largest_power(base, DIGITS_LIMIT)
        for r in range(realizations):
            key = shift_key(keys[r], d)
            if base == 2:
                word = key >> _U64(11)
                row = points[r, d]
                for i in range(count):
                    row[i] = np.float64(_U64(row[i] * _TWO_P53) ^ word) * TWO_M53
                continue
            for begin in range(0, count, _CHUNK):
                _shift_digits(points[r, d, begin : min(begin + _CHUNK, count)], key, base, power, work)


class Xor(Randomizer):
    """Adds one random digit for each place, dimension and realisation: nets stay nets."""

    def apply(self, points: Array, realizations: Realizations, bases: tuple[int, ...]) -> None:
        """Shift the digits of ``points`` in place; see :meth:`Randomizer.apply`."""
        _apply(points, realizations.keys, np.array(bases, np.int64))
