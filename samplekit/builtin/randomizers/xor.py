"""Random digital shift: one random digit is added to each digit place, modulo the base (exclusive or in base 2).

L'Ecuyer and Lemieux 2002, "Recent advances in randomized quasi-Monte Carlo methods", section 5; Kollig and Keller 2002.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit.numerics.kernel import kernel
from samplekit.sampling.digits import DIGITS_LIMIT, fraction, numerator, tail_digits
from samplekit.sampling.hashing import TWO_M53, below, dimension_key, hash_index, mix64, second_key
from samplekit.sampling.radical_inverse import largest_power
from samplekit.sampling.randomizer import Randomizer

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit.sampling.realizations import Realizations

_U64 = np.uint64
_XOR = _U64(0x5BE0CD19137E2179)
_TWO_P53 = 2.0**53


@kernel("void(float64[:,:,::1], uint64[::1], int64[::1])")
def _apply(points: NDArray[np.float64], keys: NDArray[np.uint64], bases: NDArray[np.int64]) -> None:
    realizations, dims, count = points.shape
    for d in range(dims):
        base = bases[d]
        power = largest_power(base, DIGITS_LIMIT)
        for r in range(realizations):
            key = mix64(dimension_key(keys[r], d) ^ _XOR)
            row = points[r, d]
            if base == 2:
                word = key >> _U64(11)
                for i in range(count):
                    row[i] = np.float64(_U64(row[i] * _TWO_P53) ^ word) * TWO_M53
                continue
            second = second_key(key)
            tail = tail_digits(key, power)
            for i in range(count):
                rest = numerator(row[i], power)
                weight = power
                shifted = 0
                place = 0
                while weight > 1:
                    weight //= base
                    digit = rest // weight
                    rest -= digit * weight
                    added = np.int64(below(hash_index(key, second, _U64(place)), _U64(base)))
                    shifted = shifted * base + (digit + added) % base
                    place += 1
                row[i] = fraction(shifted, tail, power)


class Xor(Randomizer):
    """One random digit per place, dimension and realisation: nets stay nets."""

    def apply(self, points: NDArray[np.float64], realizations: Realizations, bases: tuple[int, ...]) -> None:
        """Shift the digits of ``points`` in place; see :meth:`Randomizer.apply`."""
        _apply(points, realizations.keys, np.array(bases, np.int64))
