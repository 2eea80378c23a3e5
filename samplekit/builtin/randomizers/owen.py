"""Owen's nested uniform scrambling, in the base of each dimension.

Owen 1995, "Randomly permuted (t,m,s)-nets and (t,s)-sequences". In base 2 the digits are flipped by a hash of the
digits before them. In a prime base b > 2 each node of the tree of digits has a random affine permutation
a d + c mod b, a != 0: any two digits go to a uniformly random pair of distinct digits, which is all that mean and
variance depend on (Owen 2003, "Variance with alternative scramblings of digital nets"). In a composite base that is no
permutation, and each node shuffles its digits.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from samplekit.numerics.kernel import kernel, reverse_bits32
from samplekit.sampling.digits import DIGITS_LIMIT, fraction, numerator, tail_digits
from samplekit.sampling.hashing import GOLDEN, TWO_M32, below, mix64
from samplekit.sampling.owen import owen_addend, owen_factor, owen_key, owen_tail, scramble_reversed, tail_value
from samplekit.sampling.permutation import shuffle
from samplekit.sampling.radical_inverse import largest_power
from samplekit.sampling.randomizer import Randomizer

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit.sampling.realizations import Realizations

_U64 = np.uint64
_U32 = np.uint32
_TWO_P32 = 2.0**32
_TWO_P53 = 2.0**53


@kernel("void(float64[:,:,::1], uint64[::1], int64[::1], boolean[::1])")
def _apply(
    points: NDArray[np.float64], keys: NDArray[np.uint64], bases: NDArray[np.int64], is_prime: NDArray[np.bool_]
) -> None:
    realizations, dims, count = points.shape
    table = np.empty(bases.max(), np.int64)
    for d in range(dims):
        base = bases[d]
        power = largest_power(base, DIGITS_LIMIT)
        for r in range(realizations):
            key = owen_key(keys[r], d)
            row = points[r, d]
            if base == 2:
                addend = owen_addend(key)
                factor = owen_factor(key)
                tail = owen_tail(key)
                for i in range(count):
                    head = _U32(row[i] * _TWO_P32)
                    digits_after = _U64((row[i] - np.float64(head) * TWO_M32) * _TWO_P53)
                    scrambled_head = scramble_reversed(reverse_bits32(head), addend, factor)
                    row[i] = np.float64(scrambled_head) * TWO_M32 + tail_value(digits_after ^ tail)
                continue
            tail_b = tail_digits(key, power)
            for i in range(count):
                rest = numerator(row[i], power)
                weight = power
                scrambled = 0
                node = key
                while weight > 1:
                    weight //= base
                    digit = rest // weight
                    rest -= digit * weight
                    random = mix64(node)
                    if is_prime[d]:
                        factor_b = 1 + np.int64(below(random, _U64(base - 1)))
                        addend_b = np.int64(below(random << _U64(32), _U64(base)))
                        permuted = (factor_b * digit + addend_b) % base
                    else:
                        shuffle(table, base, random)
                        permuted = table[digit]
                    scrambled = scrambled * base + permuted
                    node = mix64(node + GOLDEN * _U64(digit + 1))
                row[i] = fraction(scrambled, tail_b, power)


class Owen(Randomizer):
    """Random permutations of digits, each depending on all digits before it: nets stay nets, variance falls faster."""

    def apply(self, points: NDArray[np.float64], realizations: Realizations, bases: tuple[int, ...]) -> None:
        """Scramble ``points`` in place; see :meth:`Randomizer.apply`."""
        is_prime = [all(base % divisor for divisor in range(2, math.isqrt(base) + 1)) for base in bases]
        _apply(points, realizations.keys, np.array(bases, np.int64), np.array(is_prime))
