"""Nested uniform scrambling in base 2 by hashing (Owen 1995, "Randomly permuted (t,m,s)-nets and (t,s)-sequences").

Each binary digit is flipped by a random bit that depends on all digits before it. With the digits in reverse order
this is a hash in which every bit depends only on lower bits: Laine and Karras 2011, "Stratified sampling for stochastic
transparency", section 3.1, as used by Burley 2020, "Practical hash-based Owen scrambling". The multipliers are
Vegdahl's (2021). Adding a random word and multiplying by a random odd one takes any two points to each pair that a
nested scrambling allows equally often, so the variance is Owen's. A dimension's key gives 63 bits to the hash, and 21
bits for the digits past the 32nd. All points share those 21: of f = x, the variance is 1 + N^3 / 2^64 times Owen's.
"""

import numpy as np

from samplekit.kernels._compile import helper, reverse_bits32
from samplekit.kernels._hashing import TWO_M53, dimension_key, mix64

_U32 = np.uint32
_U64 = np.uint64
_OWEN = _U64(0x510E527FADE682D1)
_TAIL = _U64(0x9B05688C2B3E6C1F)


@helper
def owen_key(key: np.uint64, dimension: int) -> np.uint64:
    """The key of a dimension's scrambling."""
    return mix64(dimension_key(key, dimension) ^ _OWEN)


@helper
def owen_addend(key: np.uint64) -> np.uint32:
    """The word that the hash adds."""
    return _U32(key & _U64(0xFFFFFFFF))


@helper
def owen_factor(key: np.uint64) -> np.uint32:
    """The odd word that the hash multiplies by."""
    return _U32(key >> _U64(32)) | _U32(1)


@helper
def owen_tail(key: np.uint64) -> np.uint64:
    """21 random bits, exclusive-ored with the digits after the 32nd: zeros leave each point at its cell's left edge."""
    return mix64(key + _TAIL) >> _U64(43)


@helper
def scramble_reversed(x: np.uint32, addend: np.uint32, factor: np.uint32) -> np.uint32:
    """Scramble a 32-bit fraction whose first digit is bit 0; the result has its first digit in the top bit."""
    x = _U32(x ^ _U32(x * _U32(0x3D20ADEA)))
    x = _U32(x + addend)
    x = _U32(x * factor)
    x = _U32(x ^ _U32(x * _U32(0x05526C56)))
    x = _U32(x ^ _U32(x * _U32(0x53A22864)))
    return reverse_bits32(x)


@helper
def tail_value(tail: np.uint64) -> float:
    """The tail as a float64 in [0, 2^-32)."""
    return np.float64(tail) * TWO_M53
