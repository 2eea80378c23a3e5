"""Random permutations that any index can ask for on its own.

Up to 1024 elements: Fisher and Yates' shuffle (Durstenfeld 1964), all pairs of places equally likely.
Above: a keyed bijection of the next power of two, walked until it falls inside (cycle walking, Black and Rogaway 2002;
the idea of hashing an index to its place is Kensler's, "Correlated Multi-Jittered Sampling", Pixar 13-01, 2013).
"""

import numpy as np
from numpy.typing import NDArray

from samplekit.kernels._compile import helper
from samplekit.kernels._hashing import below, hash_index, mix64, second_key

_U64 = np.uint64
_U32 = np.uint32
SHUFFLED = 1024
"""Largest number of elements that is shuffled."""
_FEW_BITS = 10


@helper
def shuffle(out: NDArray[np.int64], count: int, key: np.uint64) -> None:
    """Write a random permutation of 0 to count - 1 into the first ``count`` elements."""
    second = second_key(key)
    for i in range(count):
        out[i] = np.int64(below(hash_index(key, second, _U64(i)), _U64(i + 1)))
    for i in range(count):
        j = out[i]
        out[i] = out[j]
        out[j] = i


@helper
def permutation_bits(count: int) -> int:
    """Number of bits of the power of two that holds ``count`` elements."""
    bits = 1
    while (1 << bits) < count:
        bits += 1
    return bits


@helper
def _scatter_once(x: np.uint32, bits: int, key: np.uint64) -> np.uint32:
    """One round of :func:`scatter`.

    Every step is a bijection modulo 2^bits: exclusive or with a constant or the word's own high bits, addition, odd
    multiplication.
    """
    mask = _U32(0xFFFFFFFF) >> _U32(32 - bits)
    half = _U32((bits + 1) >> 1)
    low = _U32(key & _U64(0xFFFFFFFF))
    high = _U32(key >> _U64(32))
    x = (x ^ low) & mask
    x = _U32(x * _U32(0x9E6C63D1)) & mask
    x = x ^ (x >> half)
    x = _U32(x + high) & mask
    x = _U32(x * _U32((low >> _U32(7)) | _U32(1))) & mask
    x = x ^ (x >> half)
    x = _U32(x * _U32(0x2C1B3C6D)) & mask
    x = (x ^ (high >> _U32(9))) & mask
    x = x ^ (x >> half)
    x = _U32(x * _U32((high >> _U32(3)) | _U32(1))) & mask
    x = x ^ (x >> half)
    x = _U32(x * _U32(0x297A2D39)) & mask
    x = x ^ (x >> half)
    return _U32(x + (low >> _U32(15)) + (high << _U32(5))) & mask


@helper
def scatter(x: np.uint32, bits: int, key: np.uint64) -> np.uint32:
    """A keyed bijection of the integers below 2^bits, 1 <= bits <= 32."""
    x = _scatter_once(x, bits, key)
    # With few bits one round leaves some pairs half as likely again as others.
    if bits <= _FEW_BITS:
        x = _scatter_once(x, bits, mix64(key))
    return x


@helper
def permute(index: int, count: int, bits: int, key: np.uint64) -> int:
    """The place of ``index`` in a random permutation of ``count`` elements, ``bits`` = permutation_bits(count)."""
    x = scatter(_U32(index), bits, key)
    while x >= count:
        x = scatter(x, bits, key)
    return np.int64(x)  # type: ignore[return-value]


@helper
def permute_range(place: NDArray[np.int64], start: int, count: int, bits: int, key: np.uint64) -> None:
    """Write what :func:`permute` returns for start, start + 1, ..., in a loop that vectorises."""
    for i in range(place.size):
        place[i] = scatter(_U32(start + i), bits, key)
    if count == 1 << bits:
        return
    waiting = np.empty(place.size, np.int64)
    walking = np.empty(place.size, np.uint32)
    left = 0
    for i in range(place.size):
        waiting[left] = i
        left += place[i] >= count
    while left > 0:
        for k in range(left):
            walking[k] = _U32(place[waiting[k]])
        for k in range(left):
            walking[k] = scatter(walking[k], bits, key)
        still = 0
        for k in range(left):
            i = waiting[k]
            place[i] = walking[k]
            waiting[still] = i
            still += place[i] >= count
        left = still


@helper
def permute_in_lines(
    place: NDArray[np.int64], lines: NDArray[np.int64], count: int, bits: int, keys: NDArray[np.uint64]
) -> None:
    """Permute each of ``place`` among ``count`` elements, in place, with the key of its line."""
    waiting = np.empty(place.size, np.int64)
    walking = np.empty(place.size, np.uint32)
    left = 0
    for i in range(place.size):
        place[i] = scatter(_U32(place[i]), bits, keys[lines[i]])
    for i in range(place.size):
        waiting[left] = i
        left += place[i] >= count
    while left > 0:
        for k in range(left):
            i = waiting[k]
            walking[k] = scatter(_U32(place[i]), bits, keys[lines[i]])
        still = 0
        for k in range(left):
            i = waiting[k]
            place[i] = walking[k]
            waiting[still] = i
            still += place[i] >= count
        left = still
