"""Owen's nested uniform scrambling, in the base of each dimension.

Owen 1995, "Randomly permuted (t,m,s)-nets and (t,s)-sequences". In base 2 each digit is flipped by a hash of the digits
before it. In a prime base the digits at each node of the tree of digits are multiplied by a random factor and moved by
a random digit. In a composite base, where multiplying by a factor may be no permutation, each node shuffles its digits.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from samplekit import Randomizer, Realizations
from samplekit.kernels import (
    DIGITS_LIMIT,
    TWO_M32,
    factor_key,
    hash_index,
    helper,
    kernel,
    largest_power,
    numerator,
    owen_addend,
    owen_factor,
    owen_key,
    owen_tail,
    random_below,
    reverse_bits32,
    scramble_reversed,
    scrambled_child,
    second_key,
    shuffle,
    tail_digits,
    tail_value,
)

Array = NDArray[np.float64]

_U64 = np.uint64
_U32 = np.uint32
_TWO_P32 = 2.0**32
_TWO_P53 = 2.0**53
_CHUNK = 1024


@helper
def _scramble_binary(row: Array, key: np.uint64) -> None:
    addend = owen_addend(key)
    factor = owen_factor(key)
    tail = owen_tail(key)
    for i in range(row.size):
        head = _U32(row[i] * _TWO_P32)
        digits_after = _U64((row[i] - np.float64(head) * TWO_M32) * _TWO_P53)
        scrambled_head = scramble_reversed(reverse_bits32(head), addend, factor)
        row[i] = np.float64(scrambled_head) * TWO_M32 + tail_value(digits_after ^ tail)


@helper
def _scramble_digits(row: Array, key: np.uint64, base: int, power: int, is_prime: bool, work: Array) -> None:
    """Scramble at most ``work.shape[1]`` coordinates; ``work`` float64[4, K] is workspace."""
    rest, scrambled, digits, nodes = work
    second = second_key(key)
    b = np.float64(base)
    per_base = 1.0 / b
    root = random_below(hash_index(key, second, _U64(0)), np.float64(power))
    largest = 0.0
    for i in range(row.size):
        rest[i] = np.float64(numerator(row[i], power))
        scrambled[i] = root
        nodes[i] = 0.0
        largest = max(largest, rest[i])
    table = np.empty(base, np.int64)
    reach = 1
    weight = power
    while largest > 0.0:
        weight //= base
        w = np.float64(weight)
        per_weight = 1.0 / w
        factors = factor_key(key, reach)
        largest = 0.0
        for i in range(row.size):
            digits[i] = np.floor((rest[i] + 0.5) * per_weight)
            rest[i] -= digits[i] * w
            largest = max(largest, rest[i])
        if is_prime:
            for i in range(row.size):
                node = _U64(np.int64(nodes[i]))
                nodes[i] += digits[i] * np.float64(reach)
                step = digits[i] * (1.0 + random_below(hash_index(factors, second, node), b - 1.0))
                tail = hash_index(key, second, _U64(np.int64(nodes[i])))
                child = scrambled_child(scrambled[i], step, tail, b, per_base, w, per_weight)
                scrambled[i] = child if digits[i] > 0.0 else scrambled[i]
        else:
            for i in range(row.size):
                if digits[i] > 0.0:
                    shuffle(table, base - 1, hash_index(factors, second, _U64(np.int64(nodes[i]))))
                    nodes[i] += digits[i] * np.float64(reach)
                    step = 1.0 + np.float64(table[np.int64(digits[i]) - 1])
                    tail = hash_index(key, second, _U64(np.int64(nodes[i])))
                    scrambled[i] = scrambled_child(scrambled[i], step, tail, b, per_base, w, per_weight)
        reach *= base
    tail_b = tail_digits(key, power)
    for i in range(row.size):
        row[i] = (scrambled[i] + tail_b) / np.float64(power)


@kernel("void(float64[:,:,::1], uint64[::1], int64[::1], boolean[::1])")
def _apply(points: Array, keys: NDArray[np.uint64], bases: NDArray[np.int64], is_prime: NDArray[np.bool_]) -> None:
    realizations, dims, count = points.shape
    work = np.empty((4, min(count, _CHUNK)))
    for d in range(dims):
        power = largest_power(bases[d], DIGITS_LIMIT)
        for r in range(realizations):
            key = owen_key(keys[r], d)
            if bases[d] == 2:
                _scramble_binary(points[r, d], key)
                continue
            for begin in range(0, count, _CHUNK):
                row = points[r, d, begin : min(begin + _CHUNK, count)]
                _scramble_digits(row, key, bases[d], power, is_prime[d], work)


class Owen(Randomizer):
    """Permutes each digit at random, in a way that depends on all digits before it: nets stay nets."""

    def apply(self, points: Array, realizations: Realizations, bases: tuple[int, ...]) -> None:
        """Scramble ``points`` in place; see :meth:`Randomizer.apply`."""
        is_prime = [all(base % divisor for divisor in range(2, math.isqrt(base) + 1)) for base in bases]
        _apply(points, realizations.keys, np.array(bases, np.int64), np.array(is_prime))
