"""Nested uniform scrambling in a base b > 2 (Owen 1995, "Randomly permuted (t,m,s)-nets and (t,s)-sequences").

Point by point, after Helmer, Christensen, Kensler 2021, "Stochastic generation of (t, s) sample sequences": index i
has a parent, which is i without its leading digit c. Their scrambled radical inverses have the same digits before the
place of c, and independent random digits after it. At that place the digit of i is that of its parent plus f c modulo
b, where f is a random number among 1, ..., b - 1 for each node of the tree. In a prime base any two digits of a node
thus go to a uniformly random pair of distinct digits, and mean and variance depend on nothing else (Owen 2003,
"Variance with alternative scramblings of digital nets").
"""

import numpy as np
from numpy.typing import NDArray

from samplekit.kernels._compile import helper, kernel
from samplekit.kernels._digits import DIGITS_LIMIT, largest, largest_power, tail_digits
from samplekit.kernels._hashing import GOLDEN, TWO_M32, hash_index, mix64, random_below, second_key
from samplekit.kernels._mirrored_digits import TABLE, table_size
from samplekit.kernels._owen import owen_addend, owen_factor, owen_key, owen_tail, scramble_reversed, tail_value

_U64 = np.uint64
_U32 = np.uint32


@helper
def factor_key(key: np.uint64, reach: int) -> np.uint64:
    """The key of the factors at the place whose digit counts ``reach``, a power of the base, in the index."""
    return mix64(key + GOLDEN * _U64(reach))


@helper
def moved_digit(digit: float, step: float, base: float, per_base: float) -> float:
    """The digit plus the step, modulo the base; adding a half keeps quotients clear of their rounding."""
    total = digit + step
    return total - base * float(np.floor((total + 0.5) * per_base))


@helper
def scrambled_child(
    numerator: float,
    step: float,
    tail: np.uint64,
    base: float,
    per_base: float,
    weight: float,
    per_weight: float,
) -> float:
    """The numerator of a child from its parent's, with ``step`` added to the digit of ``weight``.

    The digits after it are random: ``tail`` are 64 random bits.
    """
    head = float(np.floor((numerator + 0.5) * per_weight))
    digit = head - base * float(np.floor((head + 0.5) * per_base))
    return (head - digit + moved_digit(digit, step, base, per_base)) * weight + random_below(tail, weight)


@helper
def _write_children(
    children: NDArray[np.float64],
    parents: NDArray[np.float64],
    parent: int,
    digit: int,
    reach: int,
    weight: float,
    key: np.uint64,
    second: np.uint64,
    base: float,
    per_base: float,
) -> None:
    """Write the points parent + digit reach, ... from the points parent, ...; both arrays may be the same."""
    factors = factor_key(key, reach)
    per_weight = 1.0 / weight
    c = np.float64(digit)
    child = parent + digit * reach
    for i in range(children.size):
        factor = 1.0 + random_below(hash_index(factors, second, _U64(parent + i)), base - 1.0)
        tail = hash_index(key, second, _U64(child + i))
        children[i] = scrambled_child(parents[i], factor * c, tail, base, per_base, weight, per_weight)


@kernel("void(float64[:,:,::1], uint64[::1], int64[::1], int64)")
def fill_nested(out: NDArray[np.float64], keys: NDArray[np.uint64], bases: NDArray[np.int64], start: int) -> None:
    """Write the radical inverses of start, start + 1, ... below 2^32 in the prime ``bases``, scrambled."""
    realizations, dims, points = out.shape
    last = start + points - 1
    table = np.empty(min(max(TABLE, largest(bases)), last + 1))
    for d in range(dims):
        base = bases[d]
        power = largest_power(base, DIGITS_LIMIT)
        denominator = np.float64(power)
        b = np.float64(base)
        per_base = 1.0 / b
        size = table_size(base, last)
        length = min(size, last + 1)
        for r in range(realizations):
            key = owen_key(keys[r], d)
            if base == 2:
                addend = owen_addend(key)
                factor = owen_factor(key)
                tail = tail_value(owen_tail(key))
                for i in range(points):
                    # The index is its mirrored digits with the first in bit 0.
                    out[r, d, i] = np.float64(scramble_reversed(_U32(start + i), addend, factor)) * TWO_M32 + tail
                continue
            second = second_key(key)
            tail = tail_digits(key, power)
            table[0] = random_below(hash_index(key, second, _U64(0)), denominator)
            filled = 1
            weight = power
            while filled < length:
                weight //= base
                for c in range(1, min(base, (length - 1) // filled + 1)):
                    begin = c * filled
                    end = min(begin + filled, length)
                    _write_children(table[begin:end], table, 0, c, filled, np.float64(weight), key, second, b, per_base)
                filled *= base
            done = 0
            while done < points:
                rest = (start + done) // size
                offset = start + done - rest * size
                run = min(size - offset, points - done)
                row = out[r, d, done : done + run]
                for i in range(run):
                    row[i] = table[offset + i]
                parent = offset
                reach = size
                weight = power // size
                while rest > 0:
                    c = rest % base
                    rest //= base
                    weight //= base
                    if c > 0:
                        _write_children(row, row, parent, c, reach, np.float64(weight), key, second, b, per_base)
                        parent += c * reach
                    reach *= base
                for i in range(run):
                    row[i] = (row[i] + tail) / denominator
                done += run
