"""Counter-based random numbers: 64-bit hashes of (seed, realisation, dimension, index).

The mixing function is the finaliser of SplitMix64 (Steele, Lea, Flood 2014, "Fast splittable pseudorandom
number generators", OOPSLA, figure 15; constants: Stafford's variant 13). It is a bijection of 64-bit words.
"""

import numpy as np

from samplekit.kernels._compile import helper

U64 = np.uint64
GOLDEN = U64(0x9E3779B97F4A7C15)
_M1 = U64(0xBF58476D1CE4E5B9)
_M2 = U64(0x94D049BB133111EB)
_DIMENSION = U64(0xD1342543DE82EF95)
_SECOND = U64(0xA0761D6478BD642F)

TWO_M53 = 2.0**-53
"""2^-53, the distance of neighbouring values of :func:`unit`."""
TWO_M32 = 2.0**-32
"""2^-32, which makes a fraction of a word of 32 bits."""
ONE_MINUS_EPSILON = 1.0 - 2.0**-53
"""The largest float64 below 1."""


@helper
def mix64(x: np.uint64) -> np.uint64:
    """A bijection of 64-bit words whose output bits depend on all input bits."""
    x = (x ^ (x >> U64(30))) * _M1
    x = (x ^ (x >> U64(27))) * _M2
    return x ^ (x >> U64(31))


@helper
def pixel_key(x: int, y: int, word: np.uint64, offset: np.uint64) -> np.uint64:
    """The key of a pixel, with the words of :func:`samplekit.seed_words`; distinct pixels give distinct keys."""
    return mix64((U64(x) | (U64(y) << U64(32))) ^ word) + offset


@helper
def dimension_key(key: np.uint64, dimension: int) -> np.uint64:
    """The key of one dimension of a realisation; distinct dimensions give distinct keys."""
    return mix64(key ^ (U64(dimension + 1) * _DIMENSION))


@helper
def second_key(key: np.uint64) -> np.uint64:
    """A second word from a dimension's key, for a hash that takes two."""
    return mix64(key + _SECOND)


@helper
def hash_index(key: np.uint64, second: np.uint64, index: np.uint64) -> np.uint64:
    """64 random bits for an index.

    Two words of key, so that two realisations never walk along the same sequence at different offsets.
    """
    x = (index + U64(1)) * GOLDEN + key
    x = (x ^ (x >> U64(30))) * _M1
    x = x ^ second
    x = (x ^ (x >> U64(27))) * _M2
    return x ^ (x >> U64(31))


@helper
def unit(bits: np.uint64) -> float:
    """The top 53 bits as a float64 in [0, 1 - 2^-53]: exact, never 1."""
    return np.float64(bits >> U64(11)) * TWO_M53


@helper
def below(bits: np.uint64, bound: np.uint64) -> np.uint64:
    """An integer in [0, bound), bound < 2^32; each value's probability is within 2^-32 of 1/bound."""
    return ((bits >> U64(32)) * bound) >> U64(32)


@helper
def random_below(bits: np.uint64, bound: float) -> float:
    """An integer from 0 to bound - 1 as a float64, for a ``bound`` of at most 2^45."""
    return float(np.floor(unit(bits) * bound))
